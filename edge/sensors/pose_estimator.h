// The position and tilt of a station. They come from the survey in the configuration or, without a
// survey, from GNSS and inclinometer. Also checks whether survey and sensors agree. Pure.
//
// A tripod is stationary, so readings are averaged. A reading that is inconsistent with the pose is
// rejected: the pose is kept, its uncertainty grows, and an alarm states why. The uncertainty grows
// from the last consistent reading to the next consistent one; without a sensor it does not grow. A
// tripod that was moved has lost its heading, too. A new position is therefore not adopted
// automatically (unless accept_move_s allows it). The alarm asks a person to set up the station
// again.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "conditions/alarm.h"
#include "edge/sensors/gnss_reading.h"
#include "edge/sensors/persisted_pose.h"
#include "edge/sensors/tilt_reading.h"
#include "geometry/wgs84.h"

namespace ols::sensors {

// The values are those of station_status_t.
enum class PoseSource { kNone, kSurveyed, kSensor };

struct StationPose {
  Geodetic position;  // of GROUND
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  PoseSource position_source = PoseSource::kNone;  // kNone: no position known yet, no bearings
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double tilt_sd_rad = 0.0;
  PoseSource tilt_source = PoseSource::kNone;  // kNone: assumed level, with level_sd_rad
};

class PoseEstimator {
 public:
  struct Config {
    std::optional<Geodetic> surveyed_position;  // of GROUND
    double surveyed_position_sd_m = 0.0;
    std::optional<Eigen::Vector2d> surveyed_tilt_rad;  // x, y
    double surveyed_tilt_sd_rad = 0.0;

    Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
    GnssFix least_fix = GnssFix::k3D;     // min fix
    double gnss_sd_floor_m = 0.01;        // a smaller stated 1-sigma is raised to this
    double gnss_memory_s = 3600.0;        // of the average
    double inclinometer_sd_rad = 2e-4;    // of its zero and mounting: not reduced by averaging
    double inclinometer_memory_s = 60.0;  // short, to follow legs that sink into soft ground
    double level_sd_rad = 0.05;           // of an unmeasured tilt
    double gnss_stale_s = 10.0;
    double inclinometer_stale_s = 3.0;
    double stuck_s = 60.0;          // stuck after this time without a change of any digit
    double alarm_sigma = 5.0;       // a reading further off is inconsistent
    double alarm_after_s = 2.0;     // alarm after this time: not for a gust or an outlier
    double restation_s = 300.0;     // inconsistent for this time: the tripod was moved
    double accept_move_s = 0.0;     // a new position is adopted after holding this long; 0: never
    double growth_m_sqrt_s = 0.01;  // of the position's 1-sigma without consistent readings
    double growth_rad_sqrt_s = 2e-5;
    double resume_s = 7 * 86400.0;  // an older persisted pose is not resumed
  };
  explicit PoseEstimator(const Config& config);
  ~PoseEstimator();

  // Resumes the pose from before a restart, if there is no survey. Call before the first reading.
  // Its sigmas grow with its age, and an alarm reports it until a sensor confirms it.
  void resume(const PersistedPose& known, double now_s, std::int64_t now_utime_us);
  // The pose to persist over a restart: measured, or confirmed by a sensor since the start.
  PersistedPose to_persist(double now_s, std::int64_t now_utime_us) const;

  // In order of time for each sensor. Readings that are out of order or not finite are ignored.
  void add(const GnssReading& reading);
  void add(const TiltReading& reading);

  StationPose pose(double now_s) const;
  // The current conditions: "gnss: 103 m from the survey", "inclinometer: stuck".
  std::vector<Alarm> alarms(double now_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
