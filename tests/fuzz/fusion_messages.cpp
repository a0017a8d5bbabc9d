// What reaches the fusion from the bus: a run of datagrams, each with its channel's kind and
// length. Whatever they say, targets are finite or named as no solution.
#include <cmath>

#include "central/app/messages.h"
#include "central/fusion/fusion.h"
#include "geometry/angles.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

void check_target(const ols::fusion::FusedTarget& target) {
  if (target.estimate.solution != ols::fusion::Solution::kOk) return;
  ols::fuzz::require(
      target.estimate.position_ecef.allFinite() && target.estimate.covariance_ecef.allFinite(),
      "a solution is finite");
}

// What a station would refuse is not asked for.
void check_slew(const ols::fusion::Slew& slew) {
  const double rate_limit = ols::kSlewRateLimit_rad_s;
  const auto within = [](double value, double limit) { return std::abs(value) <= limit; };
  ols::fuzz::require(within(slew.direction.azimuth_rad, 2.0 * ols::kPi) &&
                         within(slew.direction.elevation_rad, ols::kPi / 2.0) &&
                         within(slew.azimuth_rate_rad_s, rate_limit) &&
                         within(slew.elevation_rate_rad_s, rate_limit) &&
                         within(slew.direction_sd_rad, ols::kPi),
                     "a slew is finite and within its limits");
  ols::fuzz::require(
      slew.effect_utime_us >= slew.utime_us && slew.effect_utime_us - slew.utime_us < 1'000'000,
      "a slew takes effect within a second");
}

void receive(ols::fusion::Fusion& fusion, bool is_status, const std::string& station,
             std::string_view bytes) {
  const int size = static_cast<int>(bytes.size());
  if (is_status) {
    const auto place = ols::fusion::station_place_from("OLS_STATUS_" + station, bytes.data(), size);
    if (const auto* known = std::get_if<ols::fusion::StationPlace>(&place)) {
      if (known->no_place) {
        fusion.allow_slews(known->station, known->traits.commandable);
      } else {
        fusion.know_station(known->station, known->traits);
      }
    }
    return;
  }
  const auto measurement =
      ols::fusion::measurement_from("OLS_BEARING_" + station, bytes.data(), size);
  if (const auto* seen = std::get_if<ols::fusion::BearingMeasurement>(&measurement)) {
    const ols::fusion::FusionOutput output = fusion.add(*seen);
    for (const auto& target : output.targets) check_target(target);
    for (const auto& target : output.targets_paper) check_target(target);
    for (const auto& slew : output.slews) {
      check_slew(slew);
      static_cast<void>(to_message(slew, {}));
    }
  }
}

void receive_cue(ols::fusion::Fusion& fusion, bool is_order, std::string_view bytes) {
  const int size = static_cast<int>(bytes.size());
  if (is_order) {
    const auto order = ols::fusion::cue_order_from(bytes.data(), size);
    if (const auto* given = std::get_if<ols::fusion::CueOrder>(&order)) {
      fusion.allow_cue(given->cue, given->allow);
    }
    return;
  }
  const auto decoded = ols::fusion::cue_from(bytes.data(), size);
  if (const auto* cue = std::get_if<ols::fusion::Cue>(&decoded)) {
    for (const auto& slew : fusion.add(*cue, cue->utime_us)) check_slew(slew);
  }
}

void receive_skyline(ols::fusion::Fusion& fusion, const std::string& station,
                     std::string_view bytes) {
  const auto decoded = ols::fusion::skyline_sector_from("OLS_SKYLINE_" + station, bytes.data(),
                                                        static_cast<int>(bytes.size()));
  if (const auto* sector = std::get_if<ols::fusion::SkylineSector>(&decoded)) {
    fusion.know_skyline(*sector);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 8192) return 0;
  ols::fuzz::Input input(data, size);
  ols::fusion::FusionConfig config;
  config.admission.max_stations = 4;
  ols::fusion::Fusion fusion(config);
  while (!input.empty()) {
    const std::uint8_t kind = input.byte();
    const std::size_t length = input.byte();
    const char station[] = {"abcdefgh"[(kind >> 1) & 7], '\0'};
    if ((kind & 0x40) != 0) {
      receive_skyline(fusion, station, input.take(length));
    } else if ((kind & 0x30) != 0) {
      receive_cue(fusion, (kind & 0x20) != 0, input.take(length));
    } else {
      receive(fusion, (kind & 1) != 0, station, input.take(length));
    }
  }
  static_cast<void>(fusion.health());
  return 0;
}
