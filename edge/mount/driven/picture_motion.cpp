#include "edge/mount/driven/picture_motion.h"

#include <algorithm>
#include <cmath>

#include "geometry/angles.h"

namespace ols::mount {
namespace {

constexpr double kJudged_s = 1.5, kPath_s = 8.0;
constexpr double kLongestGap_s = 0.5;  // between pictures; after a longer one, the turns begin anew
constexpr double kMoved_rad = radians(2.0);
constexpr double kRests_rad = radians(0.5);
constexpr double kLeast_s = 1.2;  // that the turns of a camera at rest must cover
constexpr double kSigmas = 4.0;

}  // namespace

// The sum of the turns, the largest turn, and the sum's variance.
struct PictureMotion::Sum {
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

struct PictureMotion::Sums {
  Sum pan, tilt;
  double covered_s = 0.0;
};

PictureMotion::Sums PictureMotion::sums(Turns::const_iterator first) const {
  Sums all;
  for (auto seen = first; seen != turns_.end(); ++seen) {
    all.pan.add(seen->turn.pan_rad, seen->sd.pan_rad);
    all.tilt.add(seen->turn.tilt_rad, seen->sd.tilt_rad);
    all.covered_s += seen->to_s - seen->from_s;
  }
  return all;
}

void PictureMotion::add(const SeenTurn& turn, double tilt_rad) {
  constexpr double kSame_s = 1e-6;
  if (!turns_.empty() && turn.from_s < turns_.back().to_s - kSame_s) return;
  if (!turns_.empty() && turn.from_s > turns_.back().to_s + kLongestGap_s) turns_.clear();
  turns_.push_back(turn);
  turns_.back().turn.pan_rad *= std::cos(tilt_rad);
  turns_.back().sd.pan_rad *= std::cos(tilt_rad);
  while (!turns_.empty() && turn.to_s - turns_.front().from_s > kPath_s) turns_.pop_front();
}

PictureMotion::Is PictureMotion::judge(double since_s) const {
  if (turns_.empty()) return Is::kUnknown;
  const double from_s = std::max(since_s, turns_.back().to_s - kJudged_s);
  const Sums seen = sums(std::ranges::find_if(
      turns_, [from_s](const SeenTurn& turn) { return turn.from_s >= from_s; }));
  if (seen.pan.moved() || seen.tilt.moved()) return Is::kMoving;
  const bool rests = seen.pan.rests() && seen.tilt.rests();
  return rests && seen.covered_s > kLeast_s ? Is::kAtRest : Is::kUnknown;
}

bool PictureMotion::stood(double since_s, double least_rad) const {
  if (turns_.empty() || turns_.front().from_s > since_s) return false;
  const Sums seen = sums(std::ranges::find_if(
      turns_, [since_s](const SeenTurn& turn) { return turn.to_s > since_s; }));
  const double gaps_s = turns_.back().to_s - since_s - seen.covered_s;
  return seen.covered_s > kLeast_s && gaps_s < kLongestGap_s &&
         std::max(std::abs(seen.pan.turned_rad), std::abs(seen.tilt.turned_rad)) < least_rad;
}

}  // namespace ols::mount
