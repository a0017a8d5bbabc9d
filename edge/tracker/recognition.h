// Learns the target's appearance, and judges whether the followed object is still the target. If it
// is not, the tracker returns to the target.
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

  // Call when search_near() has moved the tracker to another place: forgets doubts and stored
  // states, which belong to the former place.
  void restart();
  // Advances the stored states to the next frame.
  void advance(const MotionModel& motion, const cv::Size& frame) { sure_.advance(motion, frame); }
  // Judges `followed` in this frame. appearance() must have searched this frame last.
  void judge(const TrackerInput& frame, const ReferenceFrames& references, const Particle& followed,
             double interval_s);
  // Stores the followed object if it is surely the target.
  void remember(const Particle& followed, double time_s);
  // If in doubt, searches for the target with the appearance that was stored while the followed
  // object was surely the target. It searches at three places: at the followed object, at the
  // target's place in the scene when the appearance was stored, and where the target would be if it
  // had kept its velocity. After long doubt, a weaker response is enough at these places. If
  // nothing is found, it searches in ever wider rings. A candidate in a ring must also pass
  // FollowJudge::log_odds_elsewhere(). Returns the target's state, and uses the stored appearance
  // from then on; nullopt if nothing is found.
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
