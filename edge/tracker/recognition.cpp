#include "edge/tracker/recognition.h"

#include <cmath>

#include "edge/tracker/background_change.h"

namespace ols::tracker {
namespace {

constexpr double kFoundAgain = 0.5;  // of the usual response

FollowEvidence evidence(const LearntAppearance& appearance, const TrackerInput& frame,
                        const ReferenceFrames& references, const Particle& at) {
  FollowEvidence seen{appearance.prominence(at.pixel)};
  seen.colours = appearance.first_colours(at.pixel);
  seen.separability = appearance.first_separability(at.pixel);
  const cv::Rect2d box = box_of(at.pixel, at.size_px);
  if (const auto* reference = references.without_overlap(box)) {
    seen.change = background_change(frame.gray, *reference, box);
  }
  return seen;
}

}  // namespace

void Recognition::restart() {
  judge_.start();
  sure_.clear();
  wide_search_ = {};
}

void Recognition::judge(const TrackerInput& frame, const ReferenceFrames& references,
                        const Particle& followed, double interval_s) {
  appearance_.look_at(frame, followed.pixel, followed.size_px);
  judge_.update(evidence(appearance_, frame, references, followed), interval_s);
  if (judge_.believes()) wide_search_ = {};
}

void Recognition::remember(const Particle& followed, double time_s) {
  if (judge_.sure()) sure_.offer(appearance_, followed, time_s);
}

// A piece of background often responds as the target would: it must stand out as well, and have
// changed. What is near has been looked at by a stricter rule.
std::optional<Particle> Recognition::found_far(const TrackerInput& frame,
                                               const ReferenceFrames& references,
                                               const SureMemory::State& sure,
                                               LearntAppearance& remembered) {
  constexpr double kApart = 1.5;  // windows, in boxes
  const Eigen::Vector2d& size_px = sure.still.size_px;
  const double box_px = std::sqrt(size_px.prod());
  const auto found =
      remembered.find(frame, wide_search_.next(sure.seen_px, kApart * box_px, frame.gray.size()),
                      size_px, kFoundAgain);
  if (!found || (*found - sure.still.pixel).norm() < box_px ||
      (*found - sure.moving.pixel).norm() < box_px) {
    return std::nullopt;
  }
  const Particle there{*found, Eigen::Vector2d::Zero(), size_px};
  remembered.look_at(frame, there.pixel, size_px);
  const double odds = judge_.log_odds_elsewhere(evidence(remembered, frame, references, there));
  return odds > 0.0 ? std::optional(there) : std::nullopt;
}

std::optional<Particle> Recognition::return_to_sure(const TrackerInput& frame,
                                                    const ReferenceFrames& references,
                                                    const Particle& followed) {
  constexpr double kAtOnce = 0.75;
  const SureMemory::State* sure = sure_.recall();
  if (!judge_.doubts() || !sure) return std::nullopt;
  const bool lets_go = judge_.lets_go();
  if (lets_go) judge_.start_search();
  LearntAppearance remembered = sure->appearance;
  const auto found = remembered.find(frame, {sure->moving.pixel, sure->still.pixel, followed.pixel},
                                     sure->still.size_px, lets_go ? kFoundAgain : kAtOnce);
  const auto target =
      found ? std::optional(Particle{*found, sure->moving.velocity_px_s, sure->moving.size_px})
            : found_far(frame, references, *sure, remembered);
  if (!target) return std::nullopt;
  appearance_ = remembered;
  return bounded(*target, frame.gray.size());
}

}  // namespace ols::tracker
