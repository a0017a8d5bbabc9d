#include "edge/tracker/recognition.h"

#include "edge/tracker/background_change.h"

namespace ols::tracker {

void Recognition::restart() {
  judge_.start();
  sure_.clear();
}

void Recognition::judge(const TrackerInput& frame, const ReferenceFrames& references,
                        const Particle& followed, double interval_s) {
  appearance_.look_at(frame, followed.pixel, followed.size_px);
  FollowEvidence evidence{appearance_.prominence(followed.pixel)};
  const cv::Rect2d box = box_of(followed.pixel, followed.size_px);
  if (const auto* reference = references.without_overlap(box)) {
    evidence.change = background_change(frame.gray, *reference, box);
  }
  judge_.update(evidence, interval_s);
}

void Recognition::remember(const Particle& followed, double time_s) {
  if (judge_.sure()) sure_.offer(appearance_, followed, time_s);
}

std::optional<Particle> Recognition::return_to_sure(const TrackerInput& frame,
                                                    const Particle& followed) {
  constexpr double kFoundAgain = 0.5, kAtOnce = 0.75;  // of the usual response
  const SureMemory::State* sure = sure_.recall();
  if (!judge_.doubts() || !sure) return std::nullopt;
  const bool lets_go = judge_.lets_go();
  if (lets_go) judge_.start_search();
  LearntAppearance remembered = sure->appearance;
  const auto found = remembered.find(frame, {sure->moving.pixel, sure->still.pixel, followed.pixel},
                                     sure->still.size_px, lets_go ? kFoundAgain : kAtOnce);
  if (!found) return std::nullopt;
  appearance_ = remembered;
  return bounded({*found, sure->moving.velocity_px_s, sure->moving.size_px}, frame.gray.size());
}

}  // namespace ols::tracker
