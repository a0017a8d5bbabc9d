#include "edge/detector/detection.h"

#include <algorithm>
#include <cmath>

namespace ols::detector {

double Detection::sd_px() const {
  // What a stack measures is at the middle of its images, and is carried on to the newest.
  if (evidence == Evidence::kStack) return 0.8;
  // A spot's centroid is good to a part of its size. A mover's silhouette changes from image to
  // image: parts of it are as dark as what is behind.
  const double side = std::sqrt(std::max(1.0, size_px.prod()));
  return evidence == Evidence::kSpot ? 0.5 + 0.1 * side : 1.0 + 0.2 * side;
}

}  // namespace ols::detector
