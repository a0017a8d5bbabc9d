#include "edge/mount/driven/picture_motion.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kJudged_s = 1.5;
constexpr double kLongestGap_s = 0.5;  // between pictures; after a longer one, the turns begin anew
constexpr double kMoved_rad = radians(2.0);
constexpr double kRests_rad = radians(0.5);
constexpr double kLeast_s = 1.2;  // that the turns of a camera at rest must cover
constexpr double kSigmas = 4.0;

// The turns of one axis: their sum, the one that contributes most to it, and the sum's variance.
struct Sum {
  double turned_rad = 0.0, largest_rad = 0.0, variance_rad2 = 0.0;

  void add(double turn_rad, double sd_rad) {
    turned_rad += turn_rad;
    largest_rad = std::max(largest_rad, std::abs(turn_rad));
    variance_rad2 += sd_rad * sd_rad;
  }
  bool moved() const {
    return std::abs(turned_rad) - largest_rad > kMoved_rad + kSigmas * std::sqrt(variance_rad2);
  }
  bool rests() const { return std::abs(turned_rad) < kRests_rad; }
};

}  // namespace

void PictureMotion::add(const SeenTurn& turn, double tilt_rad) {
  constexpr double kSame_s = 1e-6;
  if (!turns_.empty() && turn.from_s < turns_.back().to_s - kSame_s) return;
  if (!turns_.empty() && turn.from_s > turns_.back().to_s + kLongestGap_s) turns_.clear();
  turns_.push_back(turn);
  turns_.back().turn.pan_rad *= std::cos(tilt_rad);
  turns_.back().sd.pan_rad *= std::cos(tilt_rad);
  while (turn.to_s - turns_.front().from_s > kJudged_s) turns_.pop_front();
}

PictureMotion::Is PictureMotion::judge(double since_s) const {
  Sum pan, tilt;
  double covered_s = 0.0;
  for (const SeenTurn& seen : turns_) {
    if (seen.from_s < since_s) continue;
    pan.add(seen.turn.pan_rad, seen.sd.pan_rad);
    tilt.add(seen.turn.tilt_rad, seen.sd.tilt_rad);
    covered_s += seen.to_s - seen.from_s;
  }
  if (pan.moved() || tilt.moved()) return Is::kMoving;
  return covered_s > kLeast_s && pan.rests() && tilt.rests() ? Is::kAtRest : Is::kUnknown;
}

}  // namespace ols::mount
