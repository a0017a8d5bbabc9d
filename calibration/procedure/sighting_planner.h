// Finds the place that a person should sight next. For each place, predicts the systematic error
// over the working volume that would remain if this place were sighted in addition to all
// observations so far. Pure.
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
  double sd_m = 0.0;                               // 1-sigma of each axis
};

// The RMS per axis of the systematic error that would remain after sighting this place.
struct Foretold {
  std::string name;
  double rms_rad = 0.0;
};
// A sentence such as "mast would leave 21.3″ (gable 24.0″, barn 25.1″)". Empty if there are no
// predictions.
std::string in_words(const std::vector<Foretold>& ranked);

// Returns the predictions for places, sorted by the error that would remain, smallest first. Places
// without a prediction are left out. `model`: the station as far as it is known.
using Adviser =
    std::function<std::vector<Foretold>(const StationModel& model, const std::vector<Place>&)>;

class SightingPlanner {
 public:
  using Observed = std::function<std::vector<Observation>()>;
  // `problem`: the station's prior, the air and the references; its observations are ignored.
  // `observed`: returns the observations so far. `times`: how often each place would be sighted,
  // with alternating directions of approach.
  SightingPlanner(Problem problem, Observed observed, int times)
      : problem_(std::move(problem)), observed_(std::move(observed)), times_(times) {}

  std::vector<Foretold> rank(const StationModel& model, const std::vector<Place>& places);

 private:
  void take_observed();

  Problem problem_;
  Observed observed_;
  int times_;
  std::size_t unnamed_ = 0;           // number of unnamed stars at the last call
  std::vector<Observation> named_{};  // the same stars, with their names
};

}  // namespace ols::calibration
