// Distinguishes an object in a box from background, by means of an earlier image of that place. If
// the box shows background, it differs from that image no more than its surroundings do.
#pragma once

#include "edge/tracker/foreground_mask.h"

namespace ols::tracker {

// Returns the natural logarithm of a ratio: the mean difference from the reference inside `box`,
// divided by the median of that difference in boxes around it. For a piece of background it is
// about 0, however badly the two images are aligned and however the light has changed. For an
// object that was not there before, it is positive. The difference of a pixel is its distance from
// the range of grey levels that the reference has within a sixteenth of the box.
double background_change(const cv::Mat& gray, const ReferenceFrames::Reference& reference,
                         const cv::Rect2d& box);

}  // namespace ols::tracker
