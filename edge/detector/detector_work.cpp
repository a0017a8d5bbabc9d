#include "edge/detector/detector_work.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ols::detector {

Found PictureDetector::look(const Picture& picture) {
  if (!detector_) detector_.emplace(config_, picture.gray.size());
  Found found;
  found.mid_exposure_s = picture.mid_exposure_s;
  const auto result =
      detector_->advance(picture.gray, picture.mid_exposure_s, picture.motion, picture.stars);
  found.suspended = result.suspended;
  found.motion = result.motion;
  found.from_s = std::exchange(looked_s_, picture.mid_exposure_s);
  std::ranges::copy_if(detector_->tracklets(), std::back_inserter(found.confirmed),
                       &Tracklet::confirmed);
  for (Tracklet& tracklet : found.confirmed) tracklet.measure_outline(picture.gray);
  return found;
}

}  // namespace ols::detector
