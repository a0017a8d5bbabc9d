#include "edge/tracker/sure_memory.h"

#include <utility>

namespace ols::tracker {

void SureMemory::offer(const LearntAppearance& appearance, const Particle& target, double time_s) {
  constexpr double kEvery_s = 0.5;
  if (newer_ && time_s - newer_->time_s < kEvery_s) return;
  older_ = std::exchange(newer_, State{appearance, target, target, target.pixel, time_s});
}

void SureMemory::advance(const MotionModel& motion, const cv::Size& frame) {
  for (std::optional<State>* state : {&newer_, &older_}) {
    if (!*state) continue;
    Particle& moving = (*state)->moving;
    Particle& still = (*state)->still;
    moving = bounded(motion.advance(moving), frame);
    still.pixel = motion.still(still.pixel);
    still = bounded(still, frame);
  }
}

const SureMemory::State* SureMemory::recall() const {
  if (older_) return &*older_;
  return newer_ ? &*newer_ : nullptr;
}

}  // namespace ols::tracker
