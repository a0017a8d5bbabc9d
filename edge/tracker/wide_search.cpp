#include "edge/tracker/wide_search.h"

namespace ols::tracker {
namespace {

// Cell k of a square spiral around (0, 0).
Eigen::Vector2i spiral(int k) {
  int ring = 0;
  while ((2 * ring + 1) * (2 * ring + 1) <= k) ++ring;
  if (ring == 0) return {0, 0};
  const int side = 2 * ring;
  const int on_ring = k - (side - 1) * (side - 1);
  const int along = on_ring % side - ring;
  switch (on_ring / side) {
    case 0:
      return {along, -ring};
    case 1:
      return {ring, along};
    case 2:
      return {-along, ring};
    default:
      return {-ring, -along};
  }
}

}  // namespace

std::vector<Eigen::Vector2d> WideSearch::next(const Eigen::Vector2d& middle, double step_px,
                                              const cv::Size& frame) {
  constexpr int kAcross = 2 * kRings + 1;
  const cv::Rect2d inside({0.0, 0.0}, cv::Size2d(frame));
  std::vector<Eigen::Vector2d> places;
  for (int tried = 0; tried < kAcross * kAcross && places.size() < kPlaces; ++tried) {
    const Eigen::Vector2d place = middle + step_px * spiral(looked_).cast<double>();
    looked_ = (looked_ + 1) % (kAcross * kAcross);
    if (inside.contains({place.x(), place.y()})) places.push_back(place);
  }
  return places;
}

}  // namespace ols::tracker
