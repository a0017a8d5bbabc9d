// A cue near the stations of a site, for the tests of this folder.
#pragma once

#include "central/cues/cue_check.h"
#include "geometry/angles.h"

namespace ols::fusion::test {

inline constexpr std::int64_t kCueTime_us = 1'700'000'000'000'000;

inline Cue cue_at(double latitude_deg, double longitude_deg, double height_m) {
  Cue cue;
  cue.id = "tak.a";
  cue.utime_us = cue.state_us = kCueTime_us;
  cue.place = {radians(latitude_deg), radians(longitude_deg), height_m};
  cue.horizontal_sd_m = 10.0;
  cue.vertical_sd_m = 20.0;
  cue.velocity_sd_m_s = 2.0;
  return cue;
}
inline Cue good_cue() { return cue_at(49.2, 16.6, 400.0); }

// A registry with one station, which is 300 m below good_cue().
inline StationRegistry one_station() {
  StationRegistry stations({}, 10);
  MessageTime time;
  stations.for_status("alfa", time).station->traits.camera_ecef =
      ecef_from_geodetic({radians(49.2), radians(16.6), 100.0});
  return stations;
}

}  // namespace ols::fusion::test
