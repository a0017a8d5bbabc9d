// A station on a hill, and landmarks that it sights without any error.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "calibration/calibrate.h"
#include "calibration/guidance.h"
#include "geometry/angles.h"

namespace ols::calibration::test {

inline constexpr double kArcsec = kPi / 648000.0;

inline StationModel hill() {
  StationModel model;
  model.geometry.position = {radians(49.2), radians(16.6), 300.0};
  model.geometry.chain.heading_rad = radians(40.0);
  return model;
}

// The prior of a station with the standard deviations of a new unit, levelled to half a degree and
// surveyed to 2 cm.
inline StationPrior prior_of(const StationModel& model) {
  StationPrior prior;
  prior.model = model;
  prior.pose_sd_rad = 5.0 * kArcsec;
  for (int i = 0; i < kStationParameters; ++i) {
    prior.covariance(i, i) =
        std::pow(parameter_texts()[static_cast<std::size_t>(i)].new_unit_sd, 2);
  }
  for (const int k : {kTiltX, kTiltY}) prior.covariance(k, k) = std::pow(radians(0.5), 2);
  for (const int k : {kEast, kNorth, kUp}) prior.covariance(k, k) = std::pow(0.02, 2);
  return prior;
}

// A sighting of a landmark with the unit at these angles, rounded to whole counts. place_seen():
// the position of what the pixel of a sighting shows at this distance.
inline Observation landmark(double pan_deg, double tilt_deg, const std::string& name) {
  Observation one;
  one.kind = Kind::kLandmark;
  one.reading.pan = {std::round(pan_deg / 360.0 * 112000.0), 0.0, 1};
  one.reading.tilt = {std::round(tilt_deg / 360.0 * 112000.0), 0.0, -1};
  one.pixel = {600.0, 500.0};
  one.sd_px = 0.3;
  one.reference = name;
  return one;
}

inline FixedPoint place_seen(const StationModel& truth, const Observation& one, double distance_m,
                             double k = 0.13) {
  const PanTilt angles = corrected_angles(truth, one.reading);
  const auto line = sight(truth.geometry, {.pixel = one.pixel, .angles = angles});
  // Refraction lifts the image: the true direction is lower.
  const AzimuthElevation straight{line->direction.azimuth_rad,
                                  line->direction.elevation_rad - k * distance_m / 2.0 / 6371e3};
  const Eigen::Vector3d enu = distance_m * enu_from_azimuth_elevation(straight);
  return {line->origin_ecef + R_ecef_enu(line->origin_ecef) * enu, 0.02};
}

// An adjustment with `count` landmarks all around, each sighted twice.
inline Problem landmarks_around(const StationModel& truth, const StationModel& rough, int count) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {prior_of(rough)};
  for (int i = 0; i < count; ++i) {
    const std::string name = "landmark" + std::to_string(i);
    Observation one = landmark(-140.0 + 280.0 * i / (count - 1), i % 3 * 4.0 - 2.0, name);
    problem.references[name] = place_seen(truth, one, 800.0 + 100.0 * i);
    for (int k = 0; k < 2; ++k) {
      one.line = static_cast<unsigned>(problem.observations.size() + 1);
      problem.observations.push_back(one);
    }
  }
  return problem;
}

// An adjustment with points at infinity all around. Each is seen in both halves of the picture and
// with both directions of approach, by a unit with precise angles.
inline Problem scenery_around(const StationModel& truth, int count) {
  Problem problem;
  problem.names = {"alfa"};
  problem.stations = {prior_of(hill())};
  problem.stations[0].pose_sd_rad = kArcsec;
  for (int i = 0; i < count; ++i) {
    UnitReading reading;
    reading.pan.counts = std::round((-140.0 + 280.0 * i / (count - 1)) / 360.0 * 112000.0);
    const auto seen = predict_direction(truth, reading, {640.0, 480.0});
    const HomogeneousPoint point{enu_from_azimuth_elevation(seen->direction), 0.0};
    for (int k = 0; k < 4; ++k) {
      Observation one;
      one.kind = Kind::kScene;
      one.reference = std::to_string(i);
      one.pixel = {k < 2 ? 200.0 : 1080.0, 480.0};
      one.sd_px = 0.1;
      const int pan = k % 2 == 0 ? 1 : -1, tilt = k == 0 || k == 3 ? 1 : -1;
      one.reading = reading_towards(truth, point, one.pixel, pan, tilt).value();
      problem.observations.push_back(one);
    }
  }
  return problem;
}

// The configuration of a tripod that was just put up: its heading is unknown.
inline StationModel just_put_up() {
  StationModel rough = hill();
  rough.geometry.chain.heading_rad = radians(220.0);
  return rough;
}

inline StationModel crooked() {
  StationModel truth = hill();
  truth.geometry.chain.tilt_x_rad = radians(0.3);
  truth.geometry.chain.tilt_y_rad = radians(-0.2);
  truth.geometry.chain.mount_z_rad = 200.0 * kArcsec;
  truth.geometry.camera.fx_px *= 1.001;
  truth.pan.sin1_rad = 30.0 * kArcsec;
  truth.tilt.backlash_rad = 15.0 * kArcsec;
  return truth;
}

inline std::vector<std::string> rejected(const Adjustment& adjustment, const Calibration& found) {
  std::vector<std::string> names;
  for (std::size_t g = 0; g < found.tests.size(); ++g) {
    if (found.tests[g].rejected) names.push_back(adjustment.groups()[g].name);
  }
  return names;
}

}  // namespace ols::calibration::test
