// The region around the sun into which the unit must not point without a filter on the lens. Pure.
//
// The region is computed from the station's heading. Its margin covers a compass error of some
// degrees. It does not protect the camera if the heading is unknown.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "calibration/sky.h"
#include "geometry/station_model.h"

namespace ols::calibration {

class SunKeepOut {
 public:
  static constexpr double kRadius_deg = 8.0;  // half the picture's diagonal plus a compass error

  using UtcNow = std::function<std::int64_t()>;  // [us]
  SunKeepOut(const StationModel& model, UtcNow now) : model_(model), now_(std::move(now)) {}

  // Why the unit must not look in this direction now (angles as the unit reports them), in words;
  // empty if it may. `doubt_rad`: how far the tripod may have turned since the heading was
  // determined; it enlarges the region.
  std::string hindrance(const PanTilt& angles, double doubt_rad = 0.0) const;
  // Whether a part of the sun may be visible. True even if the sun is a little below the horizon.
  bool is_up() const;
  // Suspends the region. To be called only when a person has stated that a filter is on the lens,
  // and a picture beside the sun has confirmed it.
  void lift() { lifted_ = true; }
  void restore() { lifted_ = false; }

  // Direction from GROUND to the sun now, with refraction: east, north, up.
  Eigen::Vector3d sun_enu() const;
  std::int64_t now_utime_us() const { return now_(); }

 private:
  StationModel model_;
  UtcNow now_;
  bool lifted_ = false;
};

}  // namespace ols::calibration
