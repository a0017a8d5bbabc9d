#include "calibration/rectification.h"

#include <cmath>
#include <functional>
#include <optional>

#include "calibration/rectification_block.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Vector2d middle_of(const StationModel& model) {
  const CameraIntrinsics& camera = model.geometry.camera;
  return {0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1)};
}

double roll(const StationModel& model, const UnitReading& reading) {
  const Eigen::Matrix3d R =
      enu_from_camera(model.geometry.chain, corrected_angles(model, reading)).linear();
  return std::atan2(-R(2, 0), -R(2, 1));  // OpenCV's axes: x to the right, y down
}

double azimuth(const StationModel& model, const UnitReading&) {
  const StationModel head = head_alone(model);
  const Vector3d ray = enu_from_camera(head.geometry.chain, {}).linear() *
                       unproject(head.geometry.camera, middle_of(model)).value();
  return std::atan2(-ray.y(), std::hypot(ray.x(), ray.z()));
}

double elevation(const StationModel& model, const UnitReading& reading) {
  const ChainParameters& chain = model.geometry.chain;
  const Vector3d ray = enu_from_camera(chain, corrected_angles(model, reading)).linear() *
                       unproject(model.geometry.camera, middle_of(model)).value();
  const ShaftAngle shaft =
      shaft_angle(model.tilt, chain.tilt_sign, chain.tilt_zero_rad, reading.tilt, 0.0);
  return std::atan2(ray.z(), ray.head<2>().norm()) - shaft.nominal_rad;
}

using Angle = std::function<double(const StationModel&, const UnitReading&)>;

// By differences: each parameter a few arc seconds or their like to both sides.
double sd_of(const Angle& angle, const StationModel& model, const UnitReading& reading,
             const StationMatrix& covariance) {
  constexpr double kStep = 1e-5;
  ModelParameters J;
  for (int k = 0; k < kModelParameters; ++k) {
    ModelParameters by = ModelParameters::Zero();
    by[k] = k == kFocal || k == kCx || k == kCy ? 1e3 * kStep : kStep;
    const double ahead = angle(changed(model, by), reading);
    const double back = angle(changed(model, -by), reading);
    J[k] = (ahead - back) / (2.0 * by[k]);
  }
  const double variance = J.dot(covariance.topLeftCorner<kModelParameters, kModelParameters>() * J);
  return std::sqrt(std::max(0.0, variance));
}

struct Wanted {
  RectifiedAngle::Kind kind;
  Kind target;
  Angle angle;
};

}  // namespace

const char* to_string(RectifiedAngle::Kind kind) {
  switch (kind) {
    case RectifiedAngle::Kind::kRoll:
      return "roll";
    case RectifiedAngle::Kind::kAzimuth:
      return "azimuth";
    case RectifiedAngle::Kind::kElevation:
      return "elevation";
  }
  return "";
}

std::vector<RectifiedAngle> rectified_angles(const Problem& problem, const Adjustment& adjustment,
                                             const Calibration& found, std::size_t station) {
  const std::array<Wanted, 3> all{{{RectifiedAngle::Kind::kRoll, Kind::kLevelLine, roll},
                                   {RectifiedAngle::Kind::kAzimuth, Kind::kCross, azimuth},
                                   {RectifiedAngle::Kind::kElevation, Kind::kRuler, elevation}}};
  const StationModel& model = found.fit.state.stations[station].model;
  const StationMatrix covariance = found.covariance(adjustment.network(), station);
  std::vector<RectifiedAngle> angles;
  for (const Wanted& wanted : all) {
    for (std::size_t g = 0; g < found.tests.size(); ++g) {
      const Group& group = adjustment.groups()[g];
      if (group.kind != wanted.target || group.station != station || found.tests[g].rejected) {
        continue;
      }
      const UnitReading& reading = problem.observations[group.observations.front()].reading;
      angles.push_back({wanted.kind, wanted.angle(model, reading),
                        sd_of(wanted.angle, model, reading, covariance)});
      break;
    }
  }
  return angles;
}

}  // namespace ols::calibration
