// Which place a person should sight next: what each would leave of the systematic error over the
// working volume, with everything that has been observed. Pure.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "calibration/groups.h"
#include "calibration/systematic.h"

namespace ols::calibration {

// A place that could be sighted.
struct Place {
  std::string name;
  Eigen::Vector3d ecef = Eigen::Vector3d::Zero();  // [m]
  double sd_m = 0.0;                               // of each axis
};

// What stays of the systematic error, RMS of an axis, if this place is sighted.
struct Foretold {
  std::string name;
  double rms_rad = 0.0;
};
// "mast would leave 21.3″ (gable 24.0″, barn 25.1″)". Empty where nothing is foretold.
std::string in_words(const std::vector<Foretold>& ranked);

// The places by what they would leave, the best first; those that cannot be foretold are left out.
// `model`: the station as far as it is known.
using Adviser =
    std::function<std::vector<Foretold>(const StationModel& model, const std::vector<Place>&)>;

class SightingPlanner {
 public:
  using Observed = std::function<std::vector<Observation>()>;
  // `problem`: the station's prior, air and references; its observations do not count. `observed`:
  // what has been so far. `times`: how often a place would be sighted, from alternate sides.
  SightingPlanner(Problem problem, Observed observed, int times)
      : problem_(std::move(problem)), observed_(std::move(observed)), times_(times) {}

  std::vector<Foretold> rank(const StationModel& model, const std::vector<Place>& places);

 private:
  void take_observed();

  Problem problem_;
  Observed observed_;
  int times_;
  std::size_t unnamed_ = 0;           // stars of the last call, so many
  std::vector<Observation> named_{};  // those, with their names
};

}  // namespace ols::calibration
