// ols-bench-onvif: what drives an ONVIF camera against the simulated one, in simulated time, by
// their SOAP texts: how far it lags behind a target, the errors of its angles and whether they are
// as stated (by its reports alone, and with its pictures), when it is at rest after an emergency, a
// cut link, a station's end, and which motions in the picture raise an alarm.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "dev/bench/onvif_alarms.h"
#include "dev/bench/onvif_rig.h"
#include "dev/bench/program.h"
#include "geometry/angles.h"

namespace {

using namespace ols;
using bench::Loop;
using bench::Scene;
using bench::Watcher;

// A target that passes at a constant speed.
Loop::GoalAt passing(double rate_rad_s, double from_s) {
  return [=](double now_s) {
    const double pan_rad = radians(-60.0) + rate_rad_s * (now_s - from_s);
    return mount::Goal{now_s, {pan_rad, radians(20.0)}, {rate_rad_s, 0.0}, now_s + 0.5};
  };
}

// One that turns back and forth, at the same greatest speed, in 12 s.
Loop::GoalAt swinging(double rate_rad_s, double from_s) {
  return [=](double now_s) {
    constexpr double kTurns_rad_s = 2.0 * kPi / 12.0;
    const double phase_rad = kTurns_rad_s * (now_s - from_s);
    const double pan_rad = rate_rad_s / kTurns_rad_s * std::sin(phase_rad);
    return mount::Goal{
        now_s, {pan_rad, radians(20.0)}, {rate_rad_s * std::cos(phase_rad), 0.0}, now_s + 0.5};
  };
}

struct Case {
  const char* name;
  sim::PtzFaults faults;
  double delay_s = 0.0, delay_sd_s = 0.005;  // as configured
  bool swings = false;
  Scene scene = Scene::kLandscape;
};

// Sums of squares over frames.
struct Errors {
  double error2 = 0.0, told2 = 0.0;
  int known = 0;

  void add(double pan_rad, double variance_rad2, double truth_rad) {
    error2 += (pan_rad - truth_rad) * (pan_rad - truth_rad);
    told2 += variance_rad2;
    ++known;
  }
  void add(const Errors& more) {
    error2 += more.error2;
    told2 += more.told2;
    known += more.known;
  }
  std::string words(int frames) const {
    return fmt::format("{:.3f} | {:.2f} | {:.0f} %", degrees(std::sqrt(error2 / known)),
                       std::sqrt(told2 / error2), 100.0 * known / frames);
  }
};

struct Following {
  double lag2 = 0.0;  // [rad^2]
  int frames = 0;
  Errors reported, seen;

  void add(const Following& more) {
    lag2 += more.lag2;
    frames += more.frames;
    reported.add(more.reported);
    seen.add(more.seen);
  }
};

// Frames come 25 times a second, a tenth of a second late, and wait for the next position as the
// station lets them. The configured delay is wrong by its stated error.
Following follow(const Case& c, double rate_deg_s, std::uint64_t seed) {
  const sim::OnvifConfig device;
  mount::DriveConfig config = sim::drive_config(device.unit);
  std::mt19937_64 random(seed);
  config.positions.delay_s = c.delay_s + std::normal_distribution(0.0, c.delay_sd_s)(random);
  config.positions.delay_sd_s = c.delay_sd_s;
  config.positions.sd_rad = std::max(radians(0.01), radians(c.faults.step_deg) / std::sqrt(12.0));
  Loop loop(device, config, seed);
  loop.set_faults(c.faults);
  Watcher watcher(c.scene, seed);
  constexpr double kSettle_s = 15.0, kLast_s = 20.0, kFrame_s = 0.04, kLate_s = 0.1, kWait_s = 0.03;
  const double from_s = loop.now_s() + kSettle_s;
  const auto goal_at = (c.swings ? swinging : passing)(radians(rate_deg_s), from_s - 5.0);
  double arriving_s = loop.now_s(), frame_s = from_s;
  Following sum;
  loop.run(kSettle_s + kLast_s, goal_at, [&] {
    if (loop.now_s() >= arriving_s + kLate_s) {
      watcher.look(loop, arriving_s);
      arriving_s += kFrame_s;
    }
    if (loop.now_s() < frame_s + kLate_s + kWait_s) return;
    const double truth_rad = loop.truth(frame_s).pan_rad;
    sum.lag2 += std::pow(goal_at(frame_s)->angles.pan_rad - truth_rad, 2);
    ++sum.frames;
    if (const auto at = loop.history().at(frame_s)) {
      sum.reported.add(at->angles.pan_rad, (at->covariance + at->lasting_covariance)(0, 0),
                       truth_rad);
    }
    if (const auto at = loop.pointing().angles_at(frame_s)) {
      sum.seen.add(at->angles.pan_rad, (at->covariance + at->lasting_covariance)(0, 0), truth_rad);
    }
    frame_s += kFrame_s;
  });
  return sum;
}

// From `event` until it stands; nullopt: it did not within a quarter of a minute.
std::optional<double> rest_after(const sim::PtzFaults& faults, std::uint64_t seed,
                                 const std::function<void(Loop&)>& event,
                                 const std::function<void(Loop&)>& later = {}) {
  const sim::OnvifConfig device;
  Loop loop(device, sim::drive_config(device.unit), seed);
  loop.set_faults(faults);
  const auto goal_at = passing(radians(2.0), loop.now_s());
  loop.run(8.0, goal_at);
  event(loop);
  const double began_s = loop.now_s();
  double last_s = began_s;
  bool did_later = false;
  loop.run(15.0, goal_at, [&] {
    if (later && !did_later && loop.now_s() > began_s + 5.0) {
      later(loop);
      did_later = true;
    }
    if (loop.turns()) last_s = loop.now_s();
  });
  if (loop.turns()) return std::nullopt;
  return last_s - began_s;
}

void say_rest(const char* name, const sim::PtzFaults& faults, int seeds,
              const std::function<void(Loop&)>& event,
              const std::function<void(Loop&)>& later = {}) {
  double worst_s = 0.0;
  int never = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto rest_s = rest_after(faults, static_cast<std::uint64_t>(seed), event, later);
    never += rest_s ? 0 : 1;
    worst_s = std::max(worst_s, rest_s.value_or(0.0));
  }
  fmt::print("| {} | {} | {} of {} |\n", name,
             never == seeds ? std::string("-") : fmt::format("{:.2f}", worst_s), never, seeds);
}

void say_following(double rate_deg_s, int seeds) {
  const sim::PtzFaults late{.late_s = 0.3};
  fmt::print("Following {} deg/s, RMS over 20 s and {} seeds:\n\n", rate_deg_s, seeds);
  fmt::print(
      "| | | by positions alone | | | and pictures | | |\n|---|---|---|---|---|---|---|---|\n");
  fmt::print(
      "| camera | lag [deg] | error [deg] | told over actual | frames | error [deg] | told over "
      "actual | frames |\n");
  for (const Case& c :
       {Case{"exact", {}}, Case{"positions 0.3 s late", late, 0.3},
        Case{"in steps of 0.1 deg", {.step_deg = 0.1}},
        Case{"in steps of 0.5 deg, 0.2 s late", {.late_s = 0.2, .step_deg = 0.5}, 0.2},
        Case{"exact; the target turns back", {}, 0.0, 0.005, true},
        Case{"0.3 s late; the target turns back", late, 0.3, 0.005, true},
        Case{"the same; delay known to 50 ms", late, 0.3, 0.05, true},
        Case{"0.3 s late; blank sky", late, 0.3, 0.005, false, Scene::kBlank},
        Case{"0.3 s late, turns back; the scene drifts", late, 0.3, 0.005, true, Scene::kDrifts},
        Case{"0.3 s late; an object covers the picture", late, 0.3, 0.005, false,
             Scene::kPassing}}) {
    Following sum;
    for (int seed = 1; seed <= seeds; ++seed) {
      sum.add(follow(c, rate_deg_s, static_cast<std::uint64_t>(seed)));
    }
    fmt::print("| {} | {:.3f} | {} | {} |\n", c.name, degrees(std::sqrt(sum.lag2 / sum.frames)),
               sum.reported.words(sum.frames), sum.seen.words(sum.frames));
    std::fflush(stdout);
  }
}

void say_rests(int seeds) {
  const sim::PtzFaults good, deaf{.ignores_timeout = true};
  const auto cut = [](Loop& loop) { loop.wire().cut = true; };
  const auto mend = [](Loop& loop) { loop.wire().cut = false; };
  const auto kill = [](Loop& loop) { loop.station_lives = false; };
  const auto emergency = [](Loop& loop) { loop.drive().emergency_halt(); };
  fmt::print("\nAt rest after it, worst [s]:\n\n| event | rest [s] | never |\n|---|---|---|\n");
  say_rest("emergency", good, seeds, emergency);
  say_rest("emergency; ignores time-outs", deaf, seeds, emergency);
  say_rest("link cut", good, seeds, cut);
  say_rest(
      "link cut for 5 s and back, emergency; ignores time-outs", deaf, seeds,
      [](Loop& loop) { loop.wire().cut = true, loop.drive().emergency_halt(); }, mend);
  say_rest("station killed", good, seeds, kill);
  say_rest("station killed; ignores time-outs", deaf, seeds, kill);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"An ONVIF camera that is simulated, in simulated time: following, coming to rest",
               "ols-bench-onvif"};
  int seeds = 5;
  double rate_deg_s = 5.0;
  app.add_option("--seeds", seeds, "runs of each row")->check(CLI::Range(1, 1000));
  app.add_option("--rate", rate_deg_s, "of the target [deg/s]")->check(CLI::Range(0.1, 6.0));
  std::string part;
  app.add_option("--part", part, "only this part")
      ->check(CLI::IsMember({"following", "rests", "alarms"}));
  return ols::bench::run_program(app, argc, argv, [&] {
    const auto is_wanted = [&part](const char* name) { return part.empty() || part == name; };
    if (is_wanted("following")) say_following(rate_deg_s, seeds);
    if (is_wanted("rests")) say_rests(seeds);
    if (is_wanted("alarms")) bench::say_alarms(seeds);
  });
}
