// Regions of pan and tilt that a unit must not enter: a mast beside the tripod, people, the sun's
// glare on a window. Pure.
//
// The axes move independently of each other, so a move from one place to another may pass anywhere
// through the box that the two span. It is taken for free only when that whole box is.
#pragma once

#include <optional>
#include <vector>

#include "geometry/kinematic_chain.h"

namespace ols {

// A closed box in pan and tilt [rad], in the unit's own angles.
struct AngleBox {
  double pan_min_rad = 0.0, pan_max_rad = 0.0;
  double tilt_min_rad = 0.0, tilt_max_rad = 0.0;
};

using KeepOut = AngleBox;

// Room left beside each region, for what a unit runs on between two polls and for coarse counts.
constexpr double kKeepOutClearance_rad = 3.5e-3;  // 0.2 deg

AngleBox spanned(const PanTilt& a, const PanTilt& b);

// Whether the box reaches into a region or its clearance; touching the clearance's border is not.
bool blocked(const std::vector<KeepOut>& regions, const AngleBox& box);
bool blocked(const std::vector<KeepOut>& regions, const PanTilt& at);

// From one place to another within `travel` and without crossing a region: the corners of the
// shortest such way, the last one being `to`, the box between each and the next being free; nothing
// when there is none. A direct move that is free has one corner. From inside a region the first
// corner is straight out.
std::optional<std::vector<PanTilt>> way_round(const AngleBox& travel,
                                              const std::vector<KeepOut>& regions,
                                              const PanTilt& from, const PanTilt& to);

// A move from `now` to `wanted`, cut short so that it is free. `stops_at` is where the unit would
// come to rest if it braked now.
PanTilt cut_short(const std::vector<KeepOut>& regions, const PanTilt& now, const PanTilt& stops_at,
                  const PanTilt& wanted);

}  // namespace ols
