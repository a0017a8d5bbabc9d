// Computes the angles of a unit's shafts during an exposure from the unit's counts. Pure.
#pragma once

#include <functional>
#include <optional>

#include "sim/ptu/unit.h"
#include "sim/world/renderer.h"
#include "sim/world/unit_truth.h"

namespace ols::sim {

class ExposedUnit {
 public:
  ExposedUnit(const UnitTruth& truth, const PtuUnitConfig& unit)
      : mechanics_(truth, unit.resolution_arcsec * EIGEN_PI / 648000.0),
        exact_(truth.exact),
        offset_s_(truth.exposure_offset_s) {}

  // Sets the angles of `exposure`. `counted`: returns the angles that the unit counts at an instant
  // of its clock, from two seconds ago to now. `mid_s`: mid-exposure by that clock. Call in the
  // order of the exposures.
  void expose(const std::function<PanTilt(double)>& counted, double mid_s, ExposureTruth& exposure);

  // How long [s] after the end of the exposure expose() still needs the unit's angles.
  double longest_wait_s() const { return offset_s_ > 0.0 ? offset_s_ : 0.0; }

 private:
  UnitMechanics mechanics_;
  bool exact_;
  double offset_s_;
  std::optional<double> followed_s_;
};

}  // namespace ols::sim
