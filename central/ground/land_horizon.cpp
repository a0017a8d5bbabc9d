#include "central/ground/land_horizon.h"

#include <algorithm>
#include <stdexcept>

#include "geometry/angles.h"

namespace ols::fusion {

LandHorizon::LandHorizon(std::shared_ptr<const land::Surface> surface, const Geodetic& camera)
    : surface_(std::move(surface)), frame_(camera) {}

std::optional<land::Skyline> LandHorizon::highest_before(double azimuth_rad, double distance_m) {
  if (is_unknown_) return std::nullopt;
  constexpr double kSector_rad = 2.0 * kPi / static_cast<double>(kSectors);
  constexpr double kBeside_rad = radians(0.1);  // a look-up interpolates between two columns
  const double azimuth = wrap_two_pi(azimuth_rad);
  const std::size_t index = std::min(static_cast<std::size_t>(azimuth / kSector_rad), kSectors - 1);
  auto& sector = sectors_[index];
  // The map reaches only twice the distance, because most targets are near, and most of a map's
  // cells are far.
  const double reach_m = std::clamp(2.0 * distance_m, 1000.0, kReach_m);
  if (!sector || sector->config().reach_m < std::min(distance_m, kReach_m)) {
    const double from_rad = static_cast<double>(index) * kSector_rad - kBeside_rad;
    try {
      sector = std::make_unique<land::HorizonMap>(
          *surface_, frame_.origin(),
          land::HorizonMapConfig{.reach_m = reach_m,
                                 .from_azimuth_rad = from_rad,
                                 .sector_rad = kSector_rad + 2.0 * kBeside_rad});
    } catch (const std::invalid_argument&) {
      is_unknown_ = true;
      return std::nullopt;
    }
  }
  return sector->highest_before(azimuth, distance_m);
}

}  // namespace ols::fusion
