// Regions of pan and tilt that a unit must not enter: a mast beside the tripod, people, the sun's
// glare on a window. Pure.
//
// The axes move independently, so a move between two positions may pass anywhere through the box
// that they span. The move is free only when the whole box is free.
#pragma once

#include <optional>
#include <vector>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// A closed box in pan and tilt [rad], in the unit's own angles.
struct AngleBox {
  double pan_min_rad = 0.0, pan_max_rad = 0.0;
  double tilt_min_rad = 0.0, tilt_max_rad = 0.0;
};

using KeepOut = AngleBox;

// Clearance around each region. It allows for the travel between two polls and the size of a count.
constexpr double kKeepOutClearance_rad = 3.5e-3;  // 0.2 deg

AngleBox spanned(const PanTilt& a, const PanTilt& b);

// Whether the box overlaps a region or its clearance; touching the border of the clearance is
// allowed.
bool blocked(const std::vector<KeepOut>& regions, const AngleBox& box);
bool blocked(const std::vector<KeepOut>& regions, const PanTilt& at);

// The corners of the shortest path from `from` to `to` within `travel` that crosses no region. The
// last corner is `to`, and the box between neighbouring corners is free. nullopt if there is no
// such path. If the direct move is free, the path has one corner. From inside a region, the first
// corner is the straight way out.
std::optional<std::vector<PanTilt>> way_round(const AngleBox& travel,
                                              const std::vector<KeepOut>& regions,
                                              const PanTilt& from, const PanTilt& to);

// Shortens a move from `now` to `wanted` so that it is free. `stops_at`: where the unit would come
// to rest if it braked now.
PanTilt cut_short(const std::vector<KeepOut>& regions, const PanTilt& now, const PanTilt& stops_at,
                  const PanTilt& wanted);

}  // namespace ols::mount
