// The errors of a simulated pan-tilt unit and its camera: of gears, axes and lens, drawn from a
// seed. Some of these errors are in no model of the product. Written from docs/calibration.md,
// without the product's own model: a wrong sign in a shared model would cancel and stay unnoticed.
// Pure.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "geometry/kinematic_chain.h"
#include "geometry/lens.h"

namespace ols::sim {

// The size of the errors, as in docs/calibration.md. kNone: no errors. kWorkshop: the errors that
// remain after calibration in a workshop and transport. kNew: the errors of a unit that was never
// measured.
enum class UnitErrors { kNone, kWorkshop, kNew };

struct UnitErrorsScenario {
  UnitErrors size = UnitErrors::kNone;
  // Errors that are in no model of the product.
  double wave_arcsec = 3.0;         // amplitude of the microstep waves
  double second_worm_arcsec = 2.0;  // amplitude of the worms' second harmonic
  double jitter_arcsec = 4.5;       // 1-sigma, of each angle; independent at each count
};

// The errors of a shaft's angle, relative to its counts.
struct ShaftTruth {
  double cos1_rad = 0.0, sin1_rad = 0.0, cos2_rad = 0.0, sin2_rad = 0.0;
  double worm_cos_rad = 0.0, worm_sin_rad = 0.0;
  double second_worm_rad = 0.0, second_worm_phase = 0.0;
  double wave_rad = 0.0, wave_phase = 0.0;
  double slack_rad = 0.0;  // backlash
};

struct UnitTruth {
  bool exact = true;  // the shafts' angles are those reported, and the tilt axis is perpendicular
                      // to the pan axis
  ShaftTruth pan, tilt;
  double trunnion_rad = 0.0;
  // An exposure happens this much later than the counts that have the same stamp.
  double exposure_offset_s = 0.0;
  double jitter_rad = 0.0;
  std::uint64_t jitter_seed = 0;
};

// Draws a unit's errors. Adds the errors of mounting and lens to `chain` and `camera`.
UnitTruth draw_unit(const UnitErrorsScenario& scenario, std::uint64_t seed, ChainParameters& chain,
                    CameraIntrinsics& camera);

// 1-sigma of the camera's orientation, across and about the optical axis, with unit errors of this
// size. A correct configuration of a station without a calibration states these values.
struct MountSize {
  double across_rad = 0.0, roll_rad = 0.0;
};
MountSize stated_mount(const UnitErrorsScenario& scenario, const CameraIntrinsics& camera);

// The pose of the camera (OpenCV's axes, camera centre) in GROUND, with the shafts at these angles.
Eigen::Isometry3d camera_on(const ChainParameters& chain, double trunnion_rad,
                            const PanTilt& shafts);

// Converts between a unit's counts and its shafts' angles.
class UnitMechanics {
 public:
  // `count_rad`: the step size that the unit reports. The true step size divides a turn into a
  // whole number of counts.
  UnitMechanics(const UnitTruth& truth, double count_rad);

  // The unit is now at these counts. Call in time order and without gaps, because the shafts'
  // positions within the slack depend on earlier motion.
  void follow(const PanTilt& counted);
  // The shafts' angles at these counts, with the present slack.
  PanTilt shafts(const PanTilt& counted) const;
  // The shafts' angles of a unit at rest. `side_pan`, `side_tilt`: 1 or -1, the sign of its last
  // motion.
  PanTilt shafts_from(const PanTilt& counted, int side_pan, int side_tilt) const;

 private:
  double shaft(const ShaftTruth& axis, double counted_rad, double slack_rad,
               std::uint64_t tag) const;

  UnitTruth truth_;
  double count_rad_;
  double counts_per_turn_;
  bool followed_ = false;
  // How far each shaft is behind its motor; at most half of the slack to either side.
  PanTilt behind_;
  PanTilt newest_;
};

}  // namespace ols::sim
