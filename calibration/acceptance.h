// Judges whether a calibration is good enough to be offered to a person for acceptance. The result
// is a list of named findings, each with its value and its limit. Nothing is accepted
// automatically.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "calibration/systematic.h"

namespace ols::calibration {

struct AcceptanceLimits {
  // Systematic error per axis, over the working volume.
  double rms_arcsec = 15.0, worst_arcsec = 25.0;
  double detectable_arcsec = 30.0;  // largest detectable bias of a reference
  // The same offset as in without_itself_arcsec, in sigmas.
  double without_itself_sigma = 3.0;
  // Largest offset of a checked reference from the position that the others predict.
  double without_itself_arcsec = 20.0;
  double closing_arcsec = 12.0;            // from first to last sighting of a reference
  double sweep_px = 0.35, stars_px = 0.3;  // RMS residual of a coordinate
  // Smallest number of 60 deg sectors of azimuth that contain a reference.
  int sectors = 3;
  double elevation_deg = 10.0;  // smallest difference between lowest and highest reference
};

struct Finding {
  enum class Judgement { kGood, kUnchecked, kBad };
  std::string name;  // "systematic_rms", "detectable spire", ...
  Judgement judgement = Judgement::kGood;
  double value = 0.0;  // infinite if unchecked
  double limit = 0.0;
  std::string sentence;  // for a person
};

const char* to_string(Finding::Judgement judgement);

struct Acceptance {
  std::vector<Finding> findings;
  // The directions in which the calibration may be used; the references limit them.
  WorkingVolume volume;
  bool volume_is_cut = false;
  bool acceptable() const;  // whether no finding is bad
};

// Judges an instrument without a setup: whether its residuals, lens and gears agree with what was
// known before. Does not judge whether directions are right, because nothing determines the
// heading.
Acceptance judge_instrument(const Problem& problem, const Adjustment& adjustment,
                            const Calibration& found, std::size_t station,
                            const AcceptanceLimits& limits = {});
Acceptance judge_calibration(const Problem& problem, const Adjustment& adjustment,
                             const Calibration& found, std::size_t station,
                             const AcceptanceLimits& limits = {});

}  // namespace ols::calibration
