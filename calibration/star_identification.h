// Which star is which, without a heading: the unit's angles tell how frames lie to each other and
// to the horizon, so that one turn about the vertical brings all detections onto their stars.
//
// Each pair of a detection and a star of about its elevation votes for the turn and the lift that
// would bring one onto the other; votes of one frame that belong together fall into one cell. The
// best cells of all frames are fitted to all frames by the station's model with its priors, and the
// stars that then fall onto detections are counted. They are accepted where 12 and 60 % of those
// that could be are matched, and no other heading matches half as many.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "calibration/sky.h"
#include "calibration/star_table.h"
#include "calibration/state.h"

namespace ols::calibration {

// One exposure, and where something like a star was found in it; false detections may be among
// them.
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
    kTooFewMatched,     // less than 12, or than 60 % of those that could be
    kAmbiguous          // another heading explains half as many, or more
  };
  Verdict verdict = Verdict::kTooFewDetections;
  std::vector<IdentifiedStar> stars;  // only if identified
  double heading_rad = 0.0;           // about; only if identified
  // `possible`: as many as could be matched, because more stars than are in the table may be seen,
  // or fewer detected.
  std::size_t detections = 0, possible = 0, matched = 0, next_best = 0;
  // Relative to the model's, by these stars alone, and its 1-sigma: a lens that was refocused.
  double focal_change = 0.0, focal_sd = 0.0;
  double rms_px = 0.0;  // residual of a coordinate
  std::string finding;  // a sentence: what was found, or why not
};

// The station's heading is not used; its tilts, mounting and lens are, within their deviations.
// Three frames and more, in different directions; two may do.
StarIdentification identify_stars(const StationPrior& station, std::span<const StarFrame> frames,
                                  const StarConditions& conditions,
                                  std::span<const TableStar> table = star_table());

// Why stars may not have been identified: tries the other hemispheres, and clocks that are wrong by
// whole hours. A sentence, empty if none of these explains the frames.
std::string explain_unidentified(const StationPrior& station, std::span<const StarFrame> frames,
                                 const StarConditions& conditions,
                                 std::span<const TableStar> table = star_table());

}  // namespace ols::calibration
