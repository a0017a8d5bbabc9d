#include "edge/detector/detector_work.h"

#include <algorithm>
#include <iterator>

namespace ols::detector {

Found PictureDetector::look(const Picture& picture) {
  if (!detector_) detector_.emplace(config_, picture.gray.size());
  Found found;
  found.mid_exposure_s = picture.mid_exposure_s;
  found.suspended =
      detector_->advance(picture.gray, picture.mid_exposure_s, picture.motion).suspended;
  std::ranges::copy_if(detector_->tracklets(), std::back_inserter(found.confirmed),
                       &Tracklet::confirmed);
  for (Tracklet& tracklet : found.confirmed) tracklet.measure_outline(picture.gray);
  return found;
}

}  // namespace ols::detector
