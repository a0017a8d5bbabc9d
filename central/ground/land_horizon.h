// The horizon of one camera: what the land hides from it. The horizon map is computed sector by
// sector, when a sector is first needed: the whole map takes seconds, a sector some milliseconds.
// Pure.
#pragma once

#include <array>
#include <memory>
#include <optional>

#include "geometry/wgs84.h"
#include "land/horizon_map.h"

namespace ols::fusion {

class LandHorizon {
 public:
  LandHorizon(std::shared_ptr<const land::Surface> surface, const Geodetic& camera);

  // Like HorizonMap::highest_before(). nullopt if the land in that direction is unknown, or if the
  // camera would be below the surface.
  std::optional<land::Skyline> highest_before(double azimuth_rad, double distance_m);
  const LocalFrame& frame() const { return frame_; }

  static constexpr double kReach_m = 10'000.0;

 private:
  static constexpr std::size_t kSectors = 72;

  std::shared_ptr<const land::Surface> surface_;
  LocalFrame frame_;
  std::array<std::unique_ptr<land::HorizonMap>, kSectors> sectors_;
  bool is_unknown_ = false;  // the camera would be below the surface
};

}  // namespace ols::fusion
