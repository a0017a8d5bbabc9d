// Learns the target's appearance, judges whether the followed object is still the target, and
// returns to the target if it is not.
#pragma once

#include "edge/tracker/follow_judge.h"
#include "edge/tracker/foreground_mask.h"
#include "edge/tracker/sure_memory.h"
#include "edge/tracker/wide_search.h"

namespace ols::tracker {

class Recognition {
 public:
  // Starts with the target in this box of `frame`.
  Recognition(const TrackerInput& frame, const Eigen::Vector2d& pixel,
              const Eigen::Vector2d& size_px)
      : appearance_(frame, pixel, size_px) {}

  LearntAppearance& appearance() { return appearance_; }
  // Probability that the followed object is the target.
  double belief() const { return judge_.belief(); }
  // If true, nothing is learnt, because the followed object may be another one.
  bool doubts() const { return judge_.wary(); }

  // Call if a caller states where the target is: earlier doubts and memories then belong to another
  // place.
  void restart();
  // Advances the memories to the next frame.
  void advance(const MotionModel& motion, const cv::Size& frame) { sure_.advance(motion, frame); }
  // Judges `followed` in this frame. The frame must be the one that was searched last.
  void judge(const TrackerInput& frame, const ReferenceFrames& references, const Particle& followed,
             double interval_s);
  // Stores the followed object if it is surely the target.
  void remember(const Particle& followed, double time_s);
  // In doubt, returns to the appearance that was learnt while the object was surely the target.
  // With that appearance, the target must be found at one of three places: here, where it was then,
  // or where it would be if it had continued. After long doubt, a weaker response is enough. The
  // search also continues in ever wider rings, where a candidate must itself be judged to be the
  // target.
  std::optional<Particle> return_to_sure(const TrackerInput& frame,
                                         const ReferenceFrames& references,
                                         const Particle& followed);

 private:
  std::optional<Particle> found_far(const TrackerInput& frame, const ReferenceFrames& references,
                                    const SureMemory::State& sure, LearntAppearance& remembered);

  LearntAppearance appearance_;
  FollowJudge judge_;
  SureMemory sure_;
  WideSearch wide_search_;
};

}  // namespace ols::tracker
