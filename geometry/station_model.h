// The model of a real station: the chain of geometry/kinematic_chain.h, with the errors of a
// pan-tilt unit's gears, bearings and time stamps.
//
// The shaft angle theta of an axis is
//
//   theta = s q n + zero + sum_k (A_k cos k theta + B_k sin k theta)
//           + W_c cos(m theta) + W_s sin(m theta) + b d / 2
//
// n: counts at the exposure. q: 2 pi divided by the counts per turn (exact, unlike the rounded
// resolution that a unit reports). s: the sign of the axis. The sum over k is the eccentricity
// of the worm wheel and the axis together: k = 1 and 2 for pan, 1 for tilt. m: number of teeth of
// the worm wheel; the worm makes one turn for each tooth. b: backlash. d = 1 or -1: sign of the
// last motion in counts. In the cosines and sines, s q n + zero is used for theta. There is no
// error of scale, because the worm wheel is a closed circle.
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "geometry/sight.h"

namespace ols {

struct AxisModel {
  // FLIR D46: motor steps of 0.9 deg, worm gear 1:70, quarter steps.
  std::int64_t counts_per_turn = 112000;
  int worm_teeth = 70;
  double cos1_rad = 0.0, sin1_rad = 0.0, cos2_rad = 0.0, sin2_rad = 0.0;
  double worm_cos_rad = 0.0, worm_sin_rad = 0.0;
  double backlash_rad = 0.0;  // difference of the shaft angle between the two approaches
};

// The unit's reading of one axis, at the time stamp of a frame.
struct AxisReading {
  double counts = 0.0;
  double counts_per_s = 0.0;
  int approach = 1;  // 1 or -1: sign of the last motion in counts
};
struct UnitReading {
  AxisReading pan, tilt;
};

// All parameters that an adjustment can change, in their order in every vector and covariance.
// Angles in radians, lengths in metres.
enum Parameter : int {
  // Parameters of the instrument:
  kFocal,   // fx [px]
  kAspect,  // fy / fx
  kCx,
  kCy,
  kK1,
  kK2,
  kMountZ,
  kMountX,
  kMountY,
  kTrunnion,
  kPanCos1,
  kPanSin1,
  kPanCos2,
  kPanSin2,
  kPanWormCos,
  kPanWormSin,
  kPanBacklash,
  kTiltCos1,
  kTiltSin1,
  kTiltWormCos,
  kTiltWormSin,
  kTiltBacklash,
  kExposureOffset,  // [s]
  kK3,
  kK4,
  // Parameters of the setup:
  kHeading,
  kTiltX,
  kTiltY,
  kEast,  // position of GROUND
  kNorth,
  kUp,
  kModelParameters
};
inline constexpr int kInstrumentParameters = kHeading;
using ModelParameters = Eigen::Matrix<double, kModelParameters, 1>;

struct StationModel {
  StationGeometry geometry;
  AxisModel pan, tilt;
  double exposure_offset_s = 0.0;  // time of the exposure minus time of the counts
};

// The angle of a shaft, with its derivative.
struct ShaftAngle {
  double rad = 0.0;          // with all errors
  double nominal_rad = 0.0;  // s q n + zero
  double by_nominal = 1.0;
};
ShaftAngle shaft_angle(const AxisModel& axis, int sign, double zero_rad, const AxisReading& reading,
                       double exposure_offset_s);

// The angles that an ideal unit would report if its shafts had the same angles as this unit's.
// sight(), view() and the kinematic chain assume an ideal unit: give them these angles.
PanTilt corrected_angles(const StationModel& model, const UnitReading& reading);

// The model with `by` added to its parameters. Its tilts and heading are relative to the horizon at
// the changed position.
StationModel changed(const StationModel& model, const ModelParameters& by);

}  // namespace ols
