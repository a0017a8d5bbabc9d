// A pan-tilt unit with camera as it really is: errors of gears, axes and lens, drawn from a seed;
// some of them are in no model of the product. Written from docs/calibration.md, never with the
// product's own model, so that a sign wrong in both does not cancel. Pure.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "geometry/kinematic_chain.h"
#include "geometry/pinhole.h"

namespace ols::sim {

// How large the errors are: none; what a workshop's calibration and the transport leave; a unit
// that nobody has measured. The sizes are those of docs/calibration.md.
enum class UnitErrors { kNone, kWorkshop, kNew };

struct UnitErrorsScenario {
  UnitErrors size = UnitErrors::kNone;
  // What no model has.
  double wave_arcsec = 3.0;         // amplitude of the waves of the microsteps
  double second_worm_arcsec = 2.0;  // amplitude of the second harmonic of the worms
  double jitter_arcsec = 4.5;       // of each angle, new at each count, 1-sigma
};

// Of a shaft, over what its counts say.
struct ShaftTruth {
  double cos1_rad = 0.0, sin1_rad = 0.0, cos2_rad = 0.0, sin2_rad = 0.0;
  double worm_cos_rad = 0.0, worm_sin_rad = 0.0;
  double second_worm_rad = 0.0, second_worm_phase = 0.0;
  double wave_rad = 0.0, wave_phase = 0.0;
  double slack_rad = 0.0;  // backlash
};

struct UnitTruth {
  bool exact = true;  // the shafts stand at the reported angles, the tilt axis is square
  ShaftTruth pan, tilt;
  double trunnion_rad = 0.0;
  double exposure_offset_s = 0.0;  // an exposure is this much later than counts of the same stamp
  double jitter_rad = 0.0;
  std::uint64_t jitter_seed = 0;
};

// What was drawn for the mounting and the lens is added to these two.
UnitTruth draw_unit(const UnitErrorsScenario& scenario, std::uint64_t seed, ChainParameters& chain,
                    CameraIntrinsics& camera);

// 1-sigma of the camera's direction on a unit of this size, across and about the optical axis: what
// an honest configuration without a calibration states.
struct MountSize {
  double across_rad = 0.0, roll_rad = 0.0;
};
MountSize stated_mount(const UnitErrorsScenario& scenario, const CameraIntrinsics& camera);

// OpenCV's camera axes and the camera's centre in GROUND, with the shafts at these angles.
Eigen::Isometry3d camera_on(const ChainParameters& chain, double trunnion_rad,
                            const PanTilt& shafts);

// Between what a unit counts and where its shafts stand.
class UnitMechanics {
 public:
  // `count_rad`: of the unit as it prints it; a turn has a whole number of counts.
  UnitMechanics(const UnitTruth& truth, double count_rad);

  // The unit is there now, by its counts. In time order and without gaps: the slack remembers.
  void follow(const PanTilt& counted);
  // Where the shafts stand at these counts, with the slack as it is now.
  PanTilt shafts(const PanTilt& counted) const;
  // Of a unit that stands and came from this side (1, -1: the sign of its last motion).
  PanTilt shafts_from(const PanTilt& counted, int side_pan, int side_tilt) const;

 private:
  double shaft(const ShaftTruth& axis, double counted_rad, double slack_rad,
               std::uint64_t tag) const;

  UnitTruth truth_;
  double count_rad_;
  double counts_per_turn_;
  bool followed_ = false;
  // How far each shaft is behind its motor; within half of the slack to both sides.
  PanTilt behind_;
  PanTilt newest_;
};

}  // namespace ols::sim
