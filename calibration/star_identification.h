// Identifies stars without knowing the heading. The unit's angles give the frames' positions
// relative to each other and to the horizon, so one turn about the vertical brings all detections
// onto their stars.
//
// Each detection is paired with each star at about its elevation. A pair votes for the turn and the
// lift that would bring the star onto the detection. The correct votes of one frame fall into one
// cell of a grid over turn and lift. The station's model with its priors is fitted to the best
// cells of all frames, and the stars that then match detections are counted. The result is accepted
// if there are at least 12 matches, if these are 60 % of the possible ones, and if no other heading
// gives half as many.
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
    kTooFewMatched,     // fewer than 12, or fewer than 60 % of the possible ones
    kAmbiguous          // another heading explains at least half as many
  };
  Verdict verdict = Verdict::kTooFewDetections;
  std::vector<IdentifiedStar> stars;  // empty unless identified
  double heading_rad = 0.0;           // approximate; valid only if identified
  // `possible`: the largest number of stars that could be matched. It is limited by the number of
  // stars in the table and by the number of detections.
  std::size_t detections = 0, possible = 0, matched = 0, next_best = 0;
  // The change of the focal length relative to the model's, determined by these stars alone, and
  // its 1-sigma. A large change shows that the lens was refocused.
  double focal_change = 0.0, focal_sd = 0.0;
  double rms_px = 0.0;  // of the residuals of each coordinate
  std::string finding;  // a sentence: what was found, or why nothing was
};

// Does not use the station's heading. Uses its tilts, mounting and lens, with their deviations.
// Give it frames in three or more different directions; two may suffice.
StarIdentification identify_stars(const StationPrior& station, std::span<const StarFrame> frames,
                                  const StarConditions& conditions,
                                  std::span<const TableStar> table = star_table());

// Explains why the stars may not have been identified: tries the other hemispheres, and clocks that
// are wrong by whole hours. Returns a sentence; empty if none of these explains the frames.
std::string explain_unidentified(const StationPrior& station, std::span<const StarFrame> frames,
                                 const StarConditions& conditions,
                                 std::span<const TableStar> table = star_table());

}  // namespace ols::calibration
