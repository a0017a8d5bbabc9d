// Distinguishes an object in a box from the background by an earlier image of that place. If the
// box shows background, it differs from that image no more than its surroundings do.
#pragma once

#include "edge/tracker/foreground_mask.h"

namespace ols::tracker {

// Natural logarithm of a ratio: the mean difference from the reference inside `box`, over the
// median of that difference in the boxes around it. It is about 0 for a piece of background,
// however badly the two images are aligned and however the light has changed, and positive for an
// object that was not there. The difference is the distance from the grey levels that the reference
// has within a sixteenth of the box.
double background_change(const cv::Mat& gray, const ReferenceFrames::Reference& reference,
                         const cv::Rect2d& box);

}  // namespace ols::tracker
