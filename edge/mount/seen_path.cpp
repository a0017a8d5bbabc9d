#include "edge/mount/seen_path.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace ols::mount {
namespace {

bool finite(const PanTilt& p) { return std::isfinite(p.pan_rad) && std::isfinite(p.tilt_rad); }

double square(double x) { return x * x; }

}  // namespace

SeenPath::Added SeenPath::add(const SeenTurn& turn) {
  constexpr double kSame_s = 1e-6;
  const bool usable =
      finite(turn.turn) && finite(turn.sd) && std::isfinite(turn.row_s) && turn.to_s > turn.from_s;
  if (!usable || (!knots_.empty() && turn.to_s <= knots_.back().picture_s)) return Added::kIgnored;
  const auto from = std::ranges::find_if(knots_, [&turn](const Knot& knot) {
    return std::abs(knot.picture_s - turn.from_s) < kSame_s;
  });
  const bool continues = from != knots_.end();
  const Knot begin = continues ? *from : Knot{turn.from_s, turn.from_s + turn.row_s, {}, {}};
  if (!continues) knots_ = {begin};
  knots_.push_back(
      {turn.to_s,
       std::max(turn.to_s + turn.row_s, knots_.back().time_s + kSame_s),
       {begin.turned.pan_rad + turn.turn.pan_rad, begin.turned.tilt_rad + turn.turn.tilt_rad},
       {begin.walk.pan_rad + square(turn.sd.pan_rad),
        begin.walk.tilt_rad + square(turn.sd.tilt_rad)}});
  while (knots_.front().time_s < knots_.back().time_s - span_s_) knots_.pop_front();
  return continues ? Added::kContinued : Added::kBegun;
}

double SeenPath::rate(std::size_t right, double PanTilt::*axis) const {
  const Knot &a = knots_[right - 1], &b = knots_[right];
  return (b.turned.*axis - a.turned.*axis) / (b.time_s - a.time_s);
}

// The largest that the neighbouring pictures show.
double SeenPath::acceleration(std::size_t right, double PanTilt::*axis) const {
  const auto change = [&](std::size_t middle) {
    const double span_s = 0.5 * (knots_[middle + 1].time_s - knots_[middle - 1].time_s);
    return std::abs(rate(middle + 1, axis) - rate(middle, axis)) / span_s;
  };
  const double before = right >= 2 ? change(right - 1) : 0.0;
  const double behind = right + 1 < knots_.size() ? change(right) : 0.0;
  return std::max(before, behind);
}

std::optional<SeenPath::At> SeenPath::at(double time_s) const {
  if (knots_.size() < 2 || !(time_s >= knots_.front().time_s)) return std::nullopt;
  const auto after = std::ranges::lower_bound(knots_, time_s, {}, &Knot::time_s);
  const auto index = static_cast<std::size_t>(std::distance(knots_.begin(), after));
  const std::size_t right = std::clamp<std::size_t>(index, 1, knots_.size() - 1);
  const Knot &a = knots_[right - 1], &b = knots_[right];
  const double gap_s = b.time_s - a.time_s, weight = (time_s - a.time_s) / gap_s;
  if (weight > 2.0) return std::nullopt;
  At result;
  result.time_s = time_s;
  for (const auto axis : {&PanTilt::pan_rad, &PanTilt::tilt_rad}) {
    result.rate.*axis = rate(right, axis);
    result.turned.*axis = a.turned.*axis + weight * gap_s * result.rate.*axis;
    result.walk.*axis = a.walk.*axis + std::max(0.0, weight * (b.walk.*axis - a.walk.*axis));
    result.bend.*axis =
        square(0.5 * gap_s * gap_s * weight * (1.0 - weight) * acceleration(right, axis));
  }
  return result;
}

}  // namespace ols::mount
