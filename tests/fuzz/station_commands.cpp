// Commands to a station, through its bus as they come from the network. Whatever they say, the
// station never has a goal outside the PTU's limits.
#include <cmath>

#include "edge/messages/messages_bus.h"
#include "tests/fuzz/fuzz_input.h"
#include "tests/fuzz/no_tracker.h"

namespace {

constexpr double kNow_s = 1000.0;
constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

ols::station::StationSettings settings() {
  ols::station::StationSettings made;
  made.id = "a";
  return made;
}

void check_goal(const ols::station::Station& station, const ols::mount::Limits& limits,
                double now_s) {
  const auto goal = station.goal(now_s);
  if (!goal) return;
  ols::fuzz::require(std::isfinite(goal->angles.pan_rad) && std::isfinite(goal->angles.tilt_rad),
                     "a goal is finite");
  ols::fuzz::require(goal->angles.pan_rad >= limits.pan_min_rad - 1e-9 &&
                         goal->angles.pan_rad <= limits.pan_max_rad + 1e-9 &&
                         goal->angles.tilt_rad >= limits.tilt_min_rad - 1e-9 &&
                         goal->angles.tilt_rad <= limits.tilt_max_rad + 1e-9,
                     "a goal is within the limits");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 4096) return 0;
  static const ols::station::StationSettings kSettings = settings();
  ols::station::Station station(kSettings.station, std::make_unique<ols::fuzz::NoTracker>());
  station.set_reference(ols::mount::Reference::kTrusted);
  station.on_angles({kNow_s - 0.02, 1e-4, {0.0, 0.0}, {}});
  ols::station::CommandTurn turn(station);
  ols::station::StationBus bus(kSettings, 1, station, turn,
                               [](const ols::recorder::RecordCommand&) { return std::string(); });
  ols::fuzz::Input input(data, size);
  double now_s = kNow_s;
  while (!input.empty()) {
    static constexpr const char* kChannels[] = {"OLS_SLEW_a", "OLS_PTU_a", "OLS_DESIGNATE_a",
                                                "OLS_RECORD_a", "OLS_OCCLUSION_a"};
    const char* channel = kChannels[input.byte() % std::size(kChannels)];
    const std::string_view bytes = input.take(input.byte());
    now_s += 0.01;
    bus.set_time({now_s, kNow_us + static_cast<std::int64_t>((now_s - kNow_s) * 1e6)}, {});
    bus.take({channel, {bytes.begin(), bytes.end()}, kNow_us, {}, input.byte() % 2 == 0});
    if (bytes.size() % 2 == 0) bus.end_turn();
    static_cast<void>(station.step(now_s));
    check_goal(station, kSettings.station.limits, now_s);
  }
  return 0;
}
