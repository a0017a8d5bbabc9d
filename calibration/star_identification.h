// Identifies stars without a heading. The unit's angles give the frames' positions relative to each
// other and to the horizon, so one turn about the vertical brings all detections onto their stars.
//
// Each pair of a detection and a star at about its elevation votes for the turn and the lift that
// would bring the star onto the detection. Correct votes of one frame fall into one cell. The
// station's model with its priors is fitted to the best cells of all frames, and the stars that
// then fall onto detections are counted. They are accepted if there are at least 12 matches, and 60
// % of the possible ones, and if no other heading gives half as many.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibration/sky.h"
#include "calibration/star_table.h"
#include "calibration/state.h"

namespace ols::calibration {

// One exposure, with the positions of detections; some of them may be false.
struct StarFrame {
  UnitReading reading;
  std::int64_t utime_us = 0;            // UTC
  std::vector<Eigen::Vector2d> pixels;  // (0, 0) is the centre of the first
};

struct StarConditions {
  Air air;
  EarthRotation earth;
  double sd_px = 0.3;  // of a detection, each coordinate
};

struct IdentifiedStar {
  std::size_t frame = 0, detection = 0;
  TableStar star;
};

struct StarIdentification {
  enum class Verdict {
    kIdentified,
    kTooFewDetections,  // clouds, or too short an exposure
    kTooFewMatched,     // fewer than 12, or than 60 % of the possible ones
    kAmbiguous          // another heading explains half as many, or more
  };
  Verdict verdict = Verdict::kTooFewDetections;
  std::vector<IdentifiedStar> stars;  // only if identified
  double heading_rad = 0.0;           // approximate; only if identified
  // `possible`: the number of stars that could be matched. It is limited by the stars in the table
  // and by the detections.
  std::size_t detections = 0, possible = 0, matched = 0, next_best = 0;
  // The change of the focal length relative to the model's, from these stars alone, and its
  // 1-sigma. It shows a refocused lens.
  double focal_change = 0.0, focal_sd = 0.0;
  double rms_px = 0.0;  // residual of a coordinate
  std::string finding;  // a sentence: what was found, or why not
};

// Does not use the station's heading. Uses its tilts, mounting and lens, within their deviations.
// Needs three or more frames in different directions; two may suffice.
StarIdentification identify_stars(const StationPrior& station, std::span<const StarFrame> frames,
                                  const StarConditions& conditions,
                                  std::span<const TableStar> table = star_table());

// Why the stars may not have been identified: tries the other hemispheres, and clocks that are
// wrong by whole hours. A sentence; empty if none of these explains the frames.
std::string explain_unidentified(const StationPrior& station, std::span<const StarFrame> frames,
                                 const StarConditions& conditions,
                                 std::span<const TableStar> table = star_table());

}  // namespace ols::calibration
