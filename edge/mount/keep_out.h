// Regions of pan and tilt that a mount must not enter: a mast beside the tripod, people, a window
// that reflects the sun. Pure.
//
// The axes move independently. A move from one position to another may therefore pass through any
// point of the box that the two positions span. The move is free (permitted) only if the whole box
// is free.
#pragma once

#include <optional>
#include <vector>

#include "geometry/kinematic_chain.h"

namespace ols::mount {

// A closed box in pan and tilt [rad], in the mount's own angles.
struct AngleBox {
  double pan_min_rad = 0.0, pan_max_rad = 0.0;
  double tilt_min_rad = 0.0, tilt_max_rad = 0.0;
};

using KeepOut = AngleBox;

// Clearance around each region, for the travel between two polls and the size of a count.
constexpr double kKeepOutClearance_rad = 3.5e-3;  // 0.2 deg

AngleBox spanned(const PanTilt& a, const PanTilt& b);

// Whether the box or the position overlaps a region or its clearance. Touching the border of the
// clearance is allowed.
bool blocked(const std::vector<KeepOut>& regions, const AngleBox& box);
bool blocked(const std::vector<KeepOut>& regions, const PanTilt& at);

// The shortest path from `from` to `to` within `travel` that crosses no region. Returns its
// corners: moves from corner to corner are free, and the last corner is `to`. If the direct move is
// free, `to` is the only corner. If `from` is inside a region, the first corner is the nearest free
// position outside that a motion of one axis reaches. nullopt if there is no such path.
std::optional<std::vector<PanTilt>> way_round(const AngleBox& travel,
                                              const std::vector<KeepOut>& regions,
                                              const PanTilt& from, const PanTilt& to);

// Shortens a move from `now` to `wanted` so that it is free. `stops_at`: the position at which the
// mount would come to rest if it braked now.
PanTilt cut_short(const std::vector<KeepOut>& regions, const PanTilt& now, const PanTilt& stops_at,
                  const PanTilt& wanted);

}  // namespace ols::mount
