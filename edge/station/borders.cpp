#include "edge/station/borders.h"

#include <algorithm>

namespace ols::station {
namespace {

using mount::AngleBox;

AzimuthElevation axis(const ChainParameters& chain, const PanTilt& angles) {
  return azimuth_elevation_from_enu(enu_from_camera(chain, angles).linear().col(2));
}

Border border(const ChainParameters& chain, const AngleBox& box, bool is_keep_out) {
  constexpr int kSide = kBorderPoints / 4;
  const std::array<PanTilt, 4> corners{{{box.pan_min_rad, box.tilt_min_rad},
                                        {box.pan_max_rad, box.tilt_min_rad},
                                        {box.pan_max_rad, box.tilt_max_rad},
                                        {box.pan_min_rad, box.tilt_max_rad}}};
  Border result{is_keep_out, {}};
  for (int i = 0; i < kBorderPoints; ++i) {
    const PanTilt& from = corners[static_cast<std::size_t>(i / kSide)];
    const PanTilt& to = corners[static_cast<std::size_t>((i / kSide + 1) % 4)];
    const double part = static_cast<double>(i % kSide) / kSide;
    result.outline[static_cast<std::size_t>(i)] =
        axis(chain, {from.pan_rad + part * (to.pan_rad - from.pan_rad),
                     from.tilt_rad + part * (to.tilt_rad - from.tilt_rad)});
  }
  return result;
}

AngleBox common(const AngleBox& a, const AngleBox& b) {
  return {std::max(a.pan_min_rad, b.pan_min_rad), std::min(a.pan_max_rad, b.pan_max_rad),
          std::max(a.tilt_min_rad, b.tilt_min_rad), std::min(a.tilt_max_rad, b.tilt_max_rad)};
}

}  // namespace

std::vector<Border> borders(const ChainParameters& chain, const mount::Limits& limits,
                            bool is_travel_known) {
  const AngleBox travel{limits.pan_min_rad, limits.pan_max_rad, limits.tilt_min_rad,
                        limits.tilt_max_rad};
  std::vector<Border> result;
  const bool moves = travel.pan_min_rad < travel.pan_max_rad;
  if (is_travel_known && moves) result.push_back(border(chain, travel, false));
  for (const mount::KeepOut& region : limits.keep_out) {
    const AngleBox box = is_travel_known ? common(travel, region) : region;
    if (box.pan_min_rad < box.pan_max_rad && box.tilt_min_rad < box.tilt_max_rad) {
      result.push_back(border(chain, box, true));
    }
  }
  return result;
}

}  // namespace ols::station
