#include "calibration/procedure/sweep_plan.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace ols::calibration {
namespace {

constexpr double kStep = 0.6;     // of the field of view: neighbours share 40 %
constexpr double kUneven = 0.12;  // of a step
constexpr int kBlockColumns = 3;

constexpr double kGolden = 0.6180339887498949;

double share(double x) { return x - std::floor(x); }

// -1..1. The squares, because the multiples of one number leave two lengths of steps only.
double uneven(int i) { return 2.0 * share(kGolden * (i + 1) * (i + 1)) - 1.0; }

std::vector<PanTilt> ring(const SweepPlanOptions& o, int poses) {
  const double step = kStep * o.field_of_view_rad.pan_rad;
  const double middle = 0.5 * (o.pan_min_rad + o.pan_max_rad);
  const double half = std::min(0.5 * (o.pan_max_rad - o.pan_min_rad), 0.5 * step * (poses - 1));
  std::vector<PanTilt> angles;
  for (int i = 0; i < poses; ++i) {
    const double even = poses > 1 ? 2.0 * half * i / (poses - 1) - half : 0.0;
    const double pan = middle + even + kUneven * std::min(step, 2.0 * half / poses) * uneven(i);
    const double tilt =
        o.ring_tilt_rad + kUneven * o.field_of_view_rad.tilt_rad * uneven(3 * i + 1);
    angles.push_back({std::clamp(pan, o.pan_min_rad, o.pan_max_rad),
                      std::clamp(tilt, o.tilt_min_rad, o.tilt_max_rad)});
  }
  return angles;
}

// Columns around the middle, over three pictures' height around the ring. In rows the worm of tilt
// would be seen in one phase of few; by the golden section it is seen in all of them.
std::vector<PanTilt> block(const SweepPlanOptions& o, int poses) {
  constexpr double kMostHeight = 1.5;  // of the field of view, upwards and downwards
  const double height = std::min(kMostHeight, 0.5 * kStep * poses / kBlockColumns);
  std::vector<PanTilt> angles;
  const double middle = 0.5 * (o.pan_min_rad + o.pan_max_rad);
  for (int i = 0; i < poses; ++i) {
    const int column = i % kBlockColumns - kBlockColumns / 2;
    const double level = height * (2.0 * share(kGolden * i) - 1.0);
    const double pan =
        middle + kStep * o.field_of_view_rad.pan_rad * (column + kUneven * uneven(i + 7));
    const double tilt = o.ring_tilt_rad + o.field_of_view_rad.tilt_rad * level;
    angles.push_back({std::clamp(pan, o.pan_min_rad, o.pan_max_rad),
                      std::clamp(tilt, o.tilt_min_rad, o.tilt_max_rad)});
  }
  return angles;
}

// Out over every other pose, back over those between.
std::vector<PanTilt> out_and_back(const std::vector<PanTilt>& ring) {
  std::vector<PanTilt> walk;
  for (std::size_t i = 0; i < ring.size(); i += 2) walk.push_back(ring[i]);
  for (std::size_t i = ring.size() - ring.size() % 2; i >= 2; i -= 2) walk.push_back(ring[i - 1]);
  return walk;
}

int sign_or(double way, int fallback) { return way == 0.0 ? fallback : way > 0.0 ? 1 : -1; }

}  // namespace

std::vector<Shot> plan_sweep(const SweepPlanOptions& options) {
  // With a third of the poses in the block a sweep of 90 and five landmarks leave 16.7 arc seconds,
  // with a fifth in rows 18.3 (docs/calibration.md, bounds).
  constexpr int kLeastPoses = 8, kOfBlock = 3;
  if (options.poses < kLeastPoses) throw std::invalid_argument("a sweep has 8 poses at least");
  const int in_block = std::max(kBlockColumns, options.poses / kOfBlock);
  std::vector<PanTilt> walk = out_and_back(ring(options, options.poses - in_block));
  const std::vector<PanTilt> above = block(options, in_block);
  walk.insert(walk.end(), above.begin(), above.end());
  if (options.allowed) {
    std::erase_if(walk, [&](const PanTilt& angles) { return !options.allowed(angles); });
  }
  if (walk.size() < kLeastPoses) {
    throw std::invalid_argument("limits and keep-out regions leave too little for a sweep");
  }
  std::vector<Shot> shots;
  PanTilt before{walk.front().pan_rad - 1.0, walk.front().tilt_rad - 1.0};
  for (const PanTilt& angles : walk) {
    // As it comes along the walk: no detour.
    shots.push_back({angles, sign_or(angles.pan_rad - before.pan_rad, 1),
                     sign_or(angles.tilt_rad - before.tilt_rad, 1), false, false, true});
    before = angles;
  }
  return shots;
}

}  // namespace ols::calibration
