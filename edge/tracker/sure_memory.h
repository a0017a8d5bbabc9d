// Stores the state of the target at the time when it was last followed with certainty. The tracker
// returns to this state when it notices that it follows another object and has learnt that object's
// appearance.
#pragma once

#include <optional>

#include "edge/tracker/learnt_appearance.h"
#include "edge/tracker/motion_model.h"

namespace ols::tracker {

class SureMemory {
 public:
  struct State {
    LearntAppearance appearance;
    // The target's state in the newest frame if it had kept its velocity (moving), and if it had
    // stopped relative to the scene (still).
    Particle moving, still;
    // The target's position in the image at that time. A camera that follows its target keeps it at
    // this position.
    Eigen::Vector2d seen_px;
    double time_s = 0.0;
  };

  void clear() { newer_.reset(), older_.reset(); }
  // Offers a state; one is stored every half second. recall() returns the last but one, if there
  // are two, because the tracker notices only after some time that it follows another object.
  void offer(const LearntAppearance& appearance, const Particle& target, double time_s);
  // Advances the stored states to the next frame.
  void advance(const MotionModel& motion, const cv::Size& frame);
  const State* recall() const;

 private:
  std::optional<State> newer_, older_;
};

}  // namespace ols::tracker
