#include "calibration/star_identification.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "calibration/star_fit.h"
#include "calibration/star_votes.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr std::size_t kLeastMatched = 12;
constexpr double kLeastShare = 0.6;
constexpr std::size_t kTimesNextBest = 2;

// Two fits of about the same heading are one.
constexpr double kSameHeading_rad = 0.01;

std::string finding_of(const StarIdentification& of) {
  using Verdict = StarIdentification::Verdict;
  const auto count = [](std::size_t n) { return static_cast<int>(n); };
  switch (of.verdict) {
    case Verdict::kTooFewDetections:
      return printed(
          "%d detections are too few, %d are needed: clouds, twilight or too short an "
          "exposure",
          count(of.detections), count(kLeastMatched));
    case Verdict::kTooFewMatched:
      return printed(
          "no heading explains the frames: the best has %d of %d detections on stars, "
          "%d could be",
          count(of.matched), count(of.detections), count(of.possible));
    case Verdict::kAmbiguous:
      return printed("two headings explain the frames: %d and %d of %d detections are on stars",
                     count(of.matched), count(of.next_best), count(of.detections));
    case Verdict::kIdentified:
      return printed("%d of %d detections are on stars, heading %.2f deg, residuals %.2f px",
                     count(of.matched), count(of.detections), degrees(wrap_two_pi(of.heading_rad)),
                     of.rms_px);
  }
  return "";
}

// A lens that was refocused: beyond what the instrument and the stars allow.
std::string refocused(const StarIdentification& of, const StationPrior& station) {
  constexpr double kSigmas = 3.0;
  const double prior_sd =
      std::sqrt(station.covariance(kFocal, kFocal)) / station.model.geometry.camera.fx_px;
  if (std::abs(of.focal_change) < kSigmas * std::hypot(prior_sd, of.focal_sd)) return "";
  return printed("; the focal length is off by %.2f thousandths: was the lens refocused?",
                 1e3 * of.focal_change);
}

StarIdentification::Verdict verdict_of(const StarIdentification& of) {
  using Verdict = StarIdentification::Verdict;
  const double share = static_cast<double>(of.matched) / static_cast<double>(of.possible);
  if (of.matched < kLeastMatched || share < kLeastShare) return Verdict::kTooFewMatched;
  return of.matched < kTimesNextBest * of.next_best ? Verdict::kAmbiguous : Verdict::kIdentified;
}

}  // namespace

StarIdentification identify_stars(const StationPrior& station, std::span<const StarFrame> frames,
                                  const StarConditions& conditions,
                                  std::span<const TableStar> table) {
  StarIdentification result;
  for (const StarFrame& frame : frames) result.detections += frame.pixels.size();
  result.finding = finding_of(result);
  if (result.detections < kLeastMatched) return result;

  const StarVotes votes(station, frames, conditions, table);
  const StarFit fit(station, votes.frames(), conditions.sd_px);
  std::optional<StarFit::Result> best;
  for (const StarHypothesis& hypothesis : votes.hypotheses()) {
    StarFit::Result one = fit.refined(hypothesis);
    if (best && std::abs(wrap_pi(one.heading_rad - best->heading_rad)) < kSameHeading_rad) {
      if (one.pairs.size() > best->pairs.size()) best = std::move(one);
    } else if (!best || one.pairs.size() > best->pairs.size()) {
      if (best) result.next_best = std::max(result.next_best, best->pairs.size());
      best = std::move(one);
    } else {
      result.next_best = std::max(result.next_best, one.pairs.size());
    }
  }
  if (best) {
    result.matched = best->pairs.size();
    result.possible = best->possible;
  }
  result.verdict = verdict_of(result);
  if (result.verdict == StarIdentification::Verdict::kIdentified) {
    result.heading_rad = best->heading_rad;
    result.rms_px = best->rms_px;
    result.focal_change = best->focal_change;
    result.focal_sd = best->focal_sd;
    for (const StarPair& pair : best->pairs) {
      const SeenFrame& frame = votes.frames()[pair.frame];
      result.stars.push_back(
          {pair.frame, frame.detections[pair.seen].index, table[frame.sky[pair.star].index]});
    }
  }
  result.finding = finding_of(result);
  if (!result.stars.empty()) result.finding += refocused(result, station);
  return result;
}

std::string explain_unidentified(const StationPrior& station, std::span<const StarFrame> frames,
                                 const StarConditions& conditions,
                                 std::span<const TableStar> table) {
  const auto explains = [&](const StationPrior& other, std::span<const StarFrame> at) {
    return identify_stars(other, at, conditions, table).verdict ==
           StarIdentification::Verdict::kIdentified;
  };
  for (const auto& [south, west] : {std::pair{true, false}, {false, true}, {true, true}}) {
    StationPrior other = station;
    Geodetic& place = other.model.geometry.position;
    if (south) place.latitude_rad *= -1.0;
    if (west) place.longitude_rad *= -1.0;
    if (!explains(other, frames)) continue;
    return printed(
        "the stars are those of latitude %.2f, longitude %.2f deg: is the sign of the "
        "position wrong?",
        degrees(place.latitude_rad), degrees(place.longitude_rad));
  }
  constexpr std::int64_t kHour_us = 3'600'000'000;
  for (int step = 2; step <= 25; ++step) {
    const int hours = step % 2 == 0 ? step / 2 : -step / 2;
    std::vector<StarFrame> other(frames.begin(), frames.end());
    for (StarFrame& frame : other) frame.utime_us += hours * kHour_us;
    if (!explains(station, other)) continue;
    return printed("the stars are those of %d h %s: is the clock UTC?", std::abs(hours),
                   hours > 0 ? "later" : "earlier");
  }
  return "";
}

}  // namespace ols::calibration
