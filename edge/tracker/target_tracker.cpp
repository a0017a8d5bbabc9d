#include "edge/tracker/target_tracker.h"

namespace ols::tracker {

const char* to_string(TrackerError error) {
  switch (error) {
    case TrackerError::kNotInitialised:
      return "not initialised";
    case TrackerError::kEmptyFrame:
      return "empty frame";
    case TrackerError::kFrameFormat:
      return "frame is not 8-bit with one channel";
    case TrackerError::kFrameSize:
      return "frame has another size";
    case TrackerError::kTime:
      return "frame is not later than the previous one";
    case TrackerError::kHomography:
      return "predicted homography is not finite";
    case TrackerError::kBox:
      return "box is outside the image, too small or not finite";
  }
  return "unknown";
}

}  // namespace ols::tracker
