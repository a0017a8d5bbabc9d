#include "calibration/procedure/preconditions.h"

#include <algorithm>

#include "conditions/printed.h"

namespace ols::calibration {
namespace {

Precondition clock_of(const StationFacts& facts, const Wanted& wanted) {
  Precondition one{facts.clock_synchronised && facts.clock_error_s < kClockOfSky_s,
                   wanted.absolute_time, ""};
  one.sentence = one.met ? printed("clock synchronised to %.4f s", facts.clock_error_s)
                         : "the clock is not synchronised: stars, sun and drones cannot be used; "
                           "wait for GNSS or a time server";
  return one;
}

// What is found is of the instrument with the configured serial numbers.
Precondition devices_of(const StationFacts& facts) {
  const auto other = std::ranges::find(facts.alarms, "other_device", &Alarm::id);
  if (other == facts.alarms.end()) {
    return {true, true, "no device says another serial number than configured"};
  }
  return {false, true,
          other->text.substr(other->text.find("another")) +
              ": correct [serials], or connect the right one"};
}

// Where the sun stands in the unit's angles is known as well as the heading; SunKeepOut's margin
// allows for a compass.
Precondition heading_of(const StationFacts& facts) {
  constexpr double kCompass_deg = 3.0;
  Precondition one{facts.heading_sd_deg <= kCompass_deg, true, ""};
  one.sentence =
      one.met ? printed("heading known to %.2f deg: the sun is kept out of the picture",
                        facts.heading_sd_deg)
              : printed(
                    "the heading is known to %.0f deg only, and the sun is up: the unit might "
                    "look at it; take a compass to it (heading_deg), or give --overcast when "
                    "no sun is to be seen",
                    facts.heading_sd_deg);
  return one;
}

}  // namespace

std::vector<Precondition> preconditions(const StationFacts& facts, const Wanted& wanted) {
  std::vector<Precondition> all;
  const auto add = [&all](bool met, bool needed, std::string good, std::string bad) {
    all.push_back({met, needed, met ? std::move(good) : std::move(bad)});
  };
  add(!facts.emergency, true, "no emergency stop",
      "emergency stop: release it and re-arm the station");
  add(!facts.stopped, true, "the station may move", "the station is stopped: release it");
  add(!facts.held_by_hand, true, "nobody operates it by hand",
      "the station is under manual operation: release it (ols-ctl NAME release)");
  add(facts.status_gap_s < wanted.status_gap_s, true, "a stop will be heard of in time",
      printed("the station's status comes every %.1f s: a stop would be heard of too late, "
              "%.1f s are needed: set status_interval_s to 0.5",
              facts.status_gap_s, wanted.status_gap_s));
  add(!facts.follows_target, true, "it follows nothing",
      "the station follows a target: release it, or wait");
  add(facts.unit_works, true, "the pan-tilt unit answers", "the pan-tilt unit does not work");
  if (!facts.moves) add(false, true, "", "the station's mount is fixed: a procedure would move it");
  add(facts.limits_known, true, "the unit is homed", "the unit's reference is missing: home it");
  add(facts.camera_works, true, "the camera delivers pictures", "the camera does not work");
  add(facts.image_width_px == wanted.image_width_px &&
          facts.image_height_px == wanted.image_height_px,
      true, "the pictures have the configured size",
      printed("the camera sends %d x %d px, the configuration says %d x %d", facts.image_width_px,
              facts.image_height_px, wanted.image_width_px, wanted.image_height_px));
  all.push_back(devices_of(facts));
  add(facts.has_position, true, printed("position known to %.2f m", facts.position_sd_m),
      "the position is not known: wait for a GNSS fix, or survey it");
  add(facts.has_tilt, false, printed("levelled, tilt known to %.3f deg", facts.tilt_sd_deg),
      "no inclinometer: level the tripod by its bubble");
  all.push_back(clock_of(facts, wanted));
  if (wanted.sun_kept_out) all.push_back(heading_of(facts));
  add(facts.alarms.empty(), false, "no alarm",
      facts.alarms.empty() ? "" : "alarm: " + facts.alarms.front().text);
  return all;
}

std::string first_hindrance(const std::vector<Precondition>& all) {
  const auto found =
      std::ranges::find_if(all, [](const Precondition& one) { return one.needed && !one.met; });
  return found == all.end() ? "" : found->sentence;
}

}  // namespace ols::calibration
