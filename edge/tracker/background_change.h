// Decides whether a box contains an object or only background, by comparison with an earlier image
// of the same place. If the box shows background, it differs from the earlier image no more than
// the surroundings of the box do.
#pragma once

#include "edge/tracker/foreground_mask.h"

namespace ols::tracker {

// Returns the natural logarithm of a ratio: the mean difference from the reference inside `box`,
// divided by the median of the mean differences in the eight neighbouring boxes. It is about 0 for
// background, even if the images are badly aligned or the light has changed. It is positive for an
// object that was not there before. The difference at a pixel is the distance of its grey level
// from a range: the range of the reference's grey levels around this pixel, up to a sixteenth of
// the box's side away.
double background_change(const cv::Mat& gray, const ReferenceFrames::Reference& reference,
                         const cv::Rect2d& box);

}  // namespace ols::tracker
