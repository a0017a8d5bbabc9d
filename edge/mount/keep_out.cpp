#include "edge/mount/keep_out.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ols::mount {

namespace {

// Corners lie this far outside of the clearance: more than a count of any unit.
constexpr double kOutside_rad = 1.2e-3;

AngleBox with_clearance(const KeepOut& r) {
  return {r.pan_min_rad - kKeepOutClearance_rad, r.pan_max_rad + kKeepOutClearance_rad,
          r.tilt_min_rad - kKeepOutClearance_rad, r.tilt_max_rad + kKeepOutClearance_rad};
}

bool overlap(const AngleBox& a, const AngleBox& b) {
  return a.pan_min_rad < b.pan_max_rad && a.pan_max_rad > b.pan_min_rad &&
         a.tilt_min_rad < b.tilt_max_rad && a.tilt_max_rad > b.tilt_min_rad;
}

bool contains(const AngleBox& box, const PanTilt& p) {
  return p.pan_rad >= box.pan_min_rad && p.pan_rad <= box.pan_max_rad &&
         p.tilt_rad >= box.tilt_min_rad && p.tilt_rad <= box.tilt_max_rad;
}

double length(const PanTilt& a, const PanTilt& b) {
  return std::abs(a.pan_rad - b.pan_rad) + std::abs(a.tilt_rad - b.tilt_rad);
}

// Straight out of every region that contains `from`: the nearest free position along one axis.
std::optional<PanTilt> way_out(const AngleBox& travel, const std::vector<KeepOut>& regions,
                               const PanTilt& from) {
  std::optional<PanTilt> nearest;
  for (const KeepOut& region : regions) {
    const AngleBox r = with_clearance(region);
    for (const PanTilt& p : {PanTilt{r.pan_min_rad - kOutside_rad, from.tilt_rad},
                             PanTilt{r.pan_max_rad + kOutside_rad, from.tilt_rad},
                             PanTilt{from.pan_rad, r.tilt_min_rad - kOutside_rad},
                             PanTilt{from.pan_rad, r.tilt_max_rad + kOutside_rad}}) {
      if (!contains(travel, p) || blocked(regions, p)) continue;
      if (!nearest || length(from, p) < length(from, *nearest)) nearest = p;
    }
  }
  return nearest;
}

std::vector<double> grid_lines(double from, double to, double min, double max,
                               const std::vector<KeepOut>& regions, bool pan) {
  std::vector<double> lines{from, to};
  for (const KeepOut& region : regions) {
    const AngleBox r = with_clearance(region);
    lines.push_back((pan ? r.pan_min_rad : r.tilt_min_rad) - kOutside_rad);
    lines.push_back((pan ? r.pan_max_rad : r.tilt_max_rad) + kOutside_rad);
  }
  std::erase_if(lines, [&](double x) { return x < min || x > max; });
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

// Shortest paths over the crossings of the lines on which a way round can turn (Dijkstra's
// algorithm; there are a few hundred crossings at most).
class Grid {
 public:
  Grid(const AngleBox& travel, const std::vector<KeepOut>& regions, const PanTilt& from,
       const PanTilt& to)
      : regions_(regions),
        pans_(grid_lines(from.pan_rad, to.pan_rad, travel.pan_min_rad, travel.pan_max_rad, regions,
                         true)),
        tilts_(grid_lines(from.tilt_rad, to.tilt_rad, travel.tilt_min_rad, travel.tilt_max_rad,
                          regions, false)),
        nodes_(pans_.size() * tilts_.size()) {}

  std::optional<std::vector<PanTilt>> path(const PanTilt& from, const PanTilt& to) {
    const auto begin = index(from);
    const auto end = index(to);
    if (!begin || !end) return std::nullopt;
    nodes_[*begin].length = 0.0;
    while (const auto next = nearest_open()) {
      if (*next == *end) break;
      expand(*next);
    }
    if (!std::isfinite(nodes_[*end].length)) return std::nullopt;
    std::vector<PanTilt> corners;
    for (std::size_t at = *end; at != *begin; at = nodes_[at].before) corners.push_back(place(at));
    std::reverse(corners.begin(), corners.end());
    return corners;
  }

 private:
  struct Node {
    double length = std::numeric_limits<double>::infinity();
    std::size_t before = 0;
    bool done = false;
  };

  PanTilt place(std::size_t i) const { return {pans_[i % pans_.size()], tilts_[i / pans_.size()]}; }

  std::optional<std::size_t> index(const PanTilt& p) const {
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const PanTilt q = place(i);
      if (q.pan_rad == p.pan_rad && q.tilt_rad == p.tilt_rad) return i;
    }
    return std::nullopt;
  }

  std::optional<std::size_t> nearest_open() {
    std::optional<std::size_t> best;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (node.done || !std::isfinite(node.length)) continue;
      if (!best || node.length < nodes_[*best].length) best = i;
    }
    return best;
  }

  void expand(std::size_t at) {
    nodes_[at].done = true;
    const std::size_t column = at % pans_.size();
    if (column > 0) join(at, at - 1);
    if (column + 1 < pans_.size()) join(at, at + 1);
    if (at >= pans_.size()) join(at, at - pans_.size());
    if (at + pans_.size() < nodes_.size()) join(at, at + pans_.size());
  }

  void join(std::size_t a, std::size_t b) {
    if (nodes_[b].done || blocked(regions_, spanned(place(a), place(b)))) return;
    const double whole = nodes_[a].length + length(place(a), place(b));
    if (whole >= nodes_[b].length) return;
    nodes_[b].length = whole;
    nodes_[b].before = a;
  }

  const std::vector<KeepOut>& regions_;
  std::vector<double> pans_, tilts_;
  std::vector<Node> nodes_;
};

// Corners between which the whole box is free are left out.
std::vector<PanTilt> straightened(const std::vector<KeepOut>& regions, const PanTilt& from,
                                  const std::vector<PanTilt>& corners) {
  std::vector<PanTilt> kept;
  PanTilt at = from;
  for (std::size_t next = 0; next < corners.size();) {
    std::size_t furthest = next;
    for (std::size_t i = next; i < corners.size(); ++i) {
      if (!blocked(regions, spanned(at, corners[i]))) furthest = i;
    }
    at = corners[furthest];
    kept.push_back(at);
    next = furthest + 1;
  }
  return kept;
}

}  // namespace

AngleBox spanned(const PanTilt& a, const PanTilt& b) {
  return {std::min(a.pan_rad, b.pan_rad), std::max(a.pan_rad, b.pan_rad),
          std::min(a.tilt_rad, b.tilt_rad), std::max(a.tilt_rad, b.tilt_rad)};
}

bool blocked(const std::vector<KeepOut>& regions, const AngleBox& box) {
  return std::any_of(regions.begin(), regions.end(),
                     [&box](const KeepOut& r) { return overlap(with_clearance(r), box); });
}

bool blocked(const std::vector<KeepOut>& regions, const PanTilt& at) {
  return blocked(regions, spanned(at, at));
}

std::optional<std::vector<PanTilt>> way_round(const AngleBox& travel,
                                              const std::vector<KeepOut>& regions,
                                              const PanTilt& from, const PanTilt& to) {
  if (!contains(travel, to) || blocked(regions, to)) return std::nullopt;
  if (!blocked(regions, spanned(from, to))) return std::vector<PanTilt>{to};
  if (blocked(regions, from)) {
    const auto out = way_out(travel, regions, from);
    if (!out) return std::nullopt;
    auto rest = way_round(travel, regions, *out, to);
    if (rest) rest->insert(rest->begin(), *out);
    return rest;
  }
  // A unit one count outside of its travel may still return.
  const AngleBox room{
      std::min(travel.pan_min_rad, from.pan_rad), std::max(travel.pan_max_rad, from.pan_rad),
      std::min(travel.tilt_min_rad, from.tilt_rad), std::max(travel.tilt_max_rad, from.tilt_rad)};
  const auto corners = Grid(room, regions, from, to).path(from, to);
  if (!corners) return std::nullopt;
  return straightened(regions, from, *corners);
}

namespace {

AngleBox swept(const PanTilt& now, const PanTilt& stops_at, const PanTilt& wanted) {
  const AngleBox braking = spanned(now, stops_at);
  return {std::min(braking.pan_min_rad, wanted.pan_rad),
          std::max(braking.pan_max_rad, wanted.pan_rad),
          std::min(braking.tilt_min_rad, wanted.tilt_rad),
          std::max(braking.tilt_max_rad, wanted.tilt_rad)};
}

// One axis of a move that would sweep over the regions, cut short at their borders.
double cut(double now, double wanted, double region_min, double region_max) {
  if (now <= region_min) return std::min(wanted, region_min);
  if (now >= region_max) return std::max(wanted, region_max);
  return now;
}

}  // namespace

PanTilt cut_short(const std::vector<KeepOut>& regions, const PanTilt& now, const PanTilt& stops_at,
                  const PanTilt& wanted) {
  const AngleBox whole = swept(now, stops_at, wanted);
  if (!blocked(regions, whole)) return wanted;
  PanTilt pan_cut = wanted, tilt_cut = wanted;
  for (const KeepOut& region : regions) {
    const AngleBox r = with_clearance(region);
    if (!overlap(r, whole)) continue;
    pan_cut.pan_rad = cut(now.pan_rad, pan_cut.pan_rad, r.pan_min_rad, r.pan_max_rad);
    tilt_cut.tilt_rad = cut(now.tilt_rad, tilt_cut.tilt_rad, r.tilt_min_rad, r.tilt_max_rad);
  }
  const bool pan_free = !blocked(regions, swept(now, stops_at, pan_cut));
  const bool tilt_free = !blocked(regions, swept(now, stops_at, tilt_cut));
  if (pan_free && tilt_free) {
    return length(pan_cut, wanted) <= length(tilt_cut, wanted) ? pan_cut : tilt_cut;
  }
  if (pan_free) return pan_cut;
  if (tilt_free) return tilt_cut;
  return {pan_cut.pan_rad, tilt_cut.tilt_rad};
}

}  // namespace ols::mount
