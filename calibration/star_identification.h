// Identifies stars without knowing the heading. The unit's angles give the frames' directions
// relative to each other and to the horizon. A single turn about the vertical, the heading,
// therefore brings all detections onto their stars.
//
// Each detection is paired with each star at about the same elevation. A pair votes for the turn
// (in azimuth) and the lift (in elevation) that would bring the detection onto the star. The
// correct votes of one frame fall into one cell of a grid over turn and lift. The station's model
// with its priors is fitted to the pairs in the best cells of all frames. The stars that then match
// detections are counted. The result is accepted if there are at least 12 matches, if they are at
// least 60 % of the possible matches, and if every other heading gives fewer than half as many.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibration/sky.h"
#include "calibration/star_table.h"
#include "calibration/state.h"

namespace ols::calibration {

// One exposure, with the pixels of the detections; some detections may be false.
struct StarFrame {
  UnitReading reading;
  std::int64_t utime_us = 0;            // UTC
  std::vector<Eigen::Vector2d> pixels;  // (0, 0) is the centre of the top-left pixel
};

struct StarConditions {
  Air air;
  EarthRotation earth;
  double sd_px = 0.3;  // 1-sigma of a detection, each coordinate
};

struct IdentifiedStar {
  std::size_t frame = 0, detection = 0;
  TableStar star;
};

struct StarIdentification {
  enum class Verdict {
    kIdentified,
    kTooFewDetections,  // clouds, or the exposure is too short
    kTooFewMatched,     // fewer than 12 matches, or fewer than 60 % of the possible ones
    kAmbiguous          // another heading gives at least half as many matches
  };
  Verdict verdict = Verdict::kTooFewDetections;
  std::vector<IdentifiedStar> stars;  // empty unless identified
  double heading_rad = 0.0;           // approximate; valid only if identified
  // `possible`: the largest possible number of matches; the number of stars in the table and the
  // number of detections limit it. `next_best`: the number of matches at the best other heading.
  std::size_t detections = 0, possible = 0, matched = 0, next_best = 0;
  // The change of the focal length, as a share of the model's focal length, and its 1-sigma. The
  // fit that determines both does not use the station's prior of the focal length. A large change
  // shows that the lens was refocused.
  double focal_change = 0.0, focal_sd = 0.0;
  double rms_px = 0.0;  // of the residuals of each coordinate
  std::string finding;  // a sentence: what was found, or why nothing was found
};

// Uses the station's tilts, mounting and lens as priors, with their 1-sigmas; does not use its
// heading. `frames`: should be in at least three different directions; two may suffice.
StarIdentification identify_stars(const StationPrior& station, std::span<const StarFrame> frames,
                                  const StarConditions& conditions,
                                  std::span<const TableStar> table = star_table());

// Looks for a reason why the stars were not identified: tries a wrong sign of latitude or
// longitude, and clocks that are wrong by whole hours. Returns a sentence; empty if none of these
// explains the frames.
std::string explain_unidentified(const StationPrior& station, std::span<const StarFrame> frames,
                                 const StarConditions& conditions,
                                 std::span<const TableStar> table = star_table());

}  // namespace ols::calibration
