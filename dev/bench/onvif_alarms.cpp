#include "dev/bench/onvif_alarms.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <string>

#include "dev/bench/onvif_rig.h"
#include "geometry/angles.h"

namespace ols::bench {
namespace {

constexpr double kMinute_s = 60.0, kLate_s = 0.1;

// A minute without an order of others.
struct Quiet {
  const char* name;
  Scene scene = Scene::kLandscape;
  Disturbance disturbance = {};
  sim::PtzFaults faults = {};
  bool moves = false;  // to and fro, by orders of the station
};

std::function<PanTilt(double)> drifting(double rate_deg_s) {
  return [=](double time_s) { return PanTilt{radians(rate_deg_s) * time_s, 0.0}; };
}

std::function<PanTilt(double)> swaying(double amplitude_deg, double hertz) {
  return [=](double time_s) {
    const double phase_rad = 2.0 * kPi * hertz * time_s;
    return PanTilt{radians(amplitude_deg) * std::sin(phase_rad),
                   radians(0.5 * amplitude_deg) * std::sin(1.3 * phase_rad)};
  };
}

// A cloud before the sun: in a tenth of a second darker by a half, and back after three seconds.
double flickering(double time_s) {
  const double phase_s = std::fmod(time_s, 6.0);
  return phase_s < 3.0 ? std::max(0.5, 1.0 - 5.0 * phase_s)
                       : std::min(1.0, 0.5 + 5.0 * (phase_s - 3.0));
}

// In fast moves of 60 degrees and slow ones, each with a rest.
Loop::GoalAt to_and_fro() {
  return [](double now_s) -> std::optional<mount::Goal> {
    const double phase_s = std::fmod(now_s, 24.0);
    if (phase_s > 20.0) return std::nullopt;
    const double pan_rad = radians(phase_s < 10.0 ? 30.0 : -30.0);
    return mount::Goal{now_s, {pan_rad, radians(5.0)}, {}, now_s + 0.5, false, true};
  };
}

void watch(Loop& loop, Watcher& watcher, double seconds, double interval_s,
           const Loop::GoalAt& goal_at, const std::function<void()>& each = {}) {
  double exposed_s = loop.now_s();
  loop.run(seconds, goal_at, [&] {
    if (loop.now_s() >= exposed_s + kLate_s) {
      watcher.look(loop, exposed_s);
      exposed_s += interval_s;
    }
    if (each) each();
  });
}

struct Alarms {
  std::uint64_t in_picture = 0;
  int others = 0;  // minutes with other alarms
};

void count(const Quiet& quiet, double interval_s, std::uint64_t seed, Alarms& alarms) {
  const sim::OnvifConfig device;
  Loop loop(device, sim::drive_config(device.unit), seed);
  Watcher watcher(quiet.scene, seed, quiet.disturbance);
  loop.set_faults(quiet.faults);
  bool others = false;
  watch(loop, watcher, kMinute_s, interval_s, quiet.moves ? to_and_fro() : nullptr, [&] {
    for (const Alarm& alarm : loop.drive().alarms(loop.now_s()))
      others = others || alarm.text.find("the picture moves") == std::string::npos;
  });
  alarms.in_picture += loop.drive().counters().unordered_in_picture;
  alarms.others += others ? 1 : 0;
}

// From the order of another client until the camera stands; nullopt: it does not in ten seconds.
std::optional<double> stands_after(double rate_deg_s, double interval_s, std::uint64_t seed) {
  const sim::OnvifConfig device;
  Loop loop(device, sim::drive_config(device.unit), seed);
  Watcher watcher(Scene::kLandscape, seed);
  watch(loop, watcher, 8.0, interval_s, {});
  loop.set_faults({.frozen = true});
  const double velocity =
      radians(rate_deg_s) / sim::drive_config(device.unit).pan.speed_per_unit_rad;
  loop.order_by_another(onvif::continuous_move("main", {velocity, 0.0}, kMinute_s));
  const double ordered_s = loop.now_s();
  double last_s = ordered_s;
  watch(loop, watcher, 10.0, interval_s, {}, [&] {
    if (loop.turns()) last_s = loop.now_s();
  });
  if (loop.turns()) return std::nullopt;
  return last_s - ordered_s;
}

void say_quiet(int seeds) {
  const sim::PtzFaults late{.late_s = 0.5};
  fmt::print(
      "\nAlarms by the picture in {} minutes without an order of others, with pictures 25 and 4 "
      "times "
      "a second: the picture moves without an order, others\n\n| | 25 Hz | | 4 Hz | "
      "|\n|---|---|---|---|---|\n",
      seeds);
  for (const Quiet& quiet :
       {Quiet{"nothing moves"}, Quiet{"blank sky", Scene::kBlank},
        Quiet{"mast sways by +-0.5 deg at 1 Hz", Scene::kLandscape, {swaying(0.5, 1.0), {}}},
        Quiet{"mast sways by +-0.9 deg at 0.5 Hz", Scene::kLandscape, {swaying(0.9, 0.5), {}}},
        Quiet{"clouds drift by 0.4 deg/s", Scene::kLandscape, {drifting(0.4), {}}},
        Quiet{"clouds drift by 1 deg/s", Scene::kLandscape, {drifting(1.0), {}}},
        Quiet{"clouds drift by 2 deg/s", Scene::kLandscape, {drifting(2.0), {}}},
        Quiet{"an object covers a fifth of the picture for 5 s", Scene::kTarget},
        Quiet{"an object covers the picture for 5 s", Scene::kPassing},
        Quiet{"the light changes by a half", Scene::kLandscape, {{}, flickering}},
        Quiet{"own moves", Scene::kLandscape, {}, {}, true},
        Quiet{"own moves, positions 0.5 s late", Scene::kLandscape, {}, late, true},
        Quiet{"own moves, pictures 1 s late", Scene::kLandscape, {{}, {}, 1.0}, {}, true},
        Quiet{"own moves, mast sways", Scene::kLandscape, {swaying(0.5, 1.0), {}}, {}, true}}) {
    Alarms fast, slow;
    for (int seed = 1; seed <= seeds; ++seed) {
      count(quiet, 0.04, static_cast<std::uint64_t>(seed), fast);
      count(quiet, 0.25, static_cast<std::uint64_t>(seed), slow);
    }
    fmt::print("| {} | {} | {} | {} | {} |\n", quiet.name, fast.in_picture, fast.others,
               slow.in_picture, slow.others);
    std::fflush(stdout);
  }
}

void say_turned(int seeds) {
  fmt::print(
      "\nAnother client turns it, its positions stay: stands after [s], worst; never\n\n"
      "| rate [deg/s] | 25 Hz | | 4 Hz | |\n|---|---|---|---|---|\n");
  for (const double rate_deg_s : {1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 20.0, 60.0}) {
    fmt::print("| {} |", rate_deg_s);
    for (const double interval_s : {0.04, 0.25}) {
      double worst_s = 0.0;
      int never = 0;
      for (int seed = 1; seed <= seeds; ++seed) {
        const auto stands_s =
            stands_after(rate_deg_s, interval_s, static_cast<std::uint64_t>(seed));
        worst_s = std::max(worst_s, stands_s.value_or(0.0));
        never += stands_s ? 0 : 1;
      }
      fmt::print(" {} | {} of {} |", never == seeds ? "-" : fmt::format("{:.1f}", worst_s), never,
                 seeds);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

}  // namespace

void say_alarms(int seeds) {
  say_quiet(seeds);
  say_turned(seeds);
}

}  // namespace ols::bench
