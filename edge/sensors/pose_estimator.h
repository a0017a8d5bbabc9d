// Estimates the position and the tilt of a station. They come from the survey in the configuration
// or, if there is none, from GNSS and inclinometer. It also checks whether survey and sensors
// agree. Pure.
//
// A tripod is stationary, so readings are averaged. A reading that is inconsistent with the pose is
// rejected: the pose remains, its uncertainty grows, and an alarm states why. The uncertainty grows
// from the last consistent reading to the next one. Without a sensor it does not grow. If a tripod
// was moved, its heading is lost, too. A new position is therefore not adopted automatically
// (unless accept_move_s allows it). The alarm asks a person to set up the station again.
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
  Geodetic position;  // of the origin of GROUND
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  // kNone: no position is known yet, so there are no bearings.
  PoseSource position_source = PoseSource::kNone;
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double tilt_sd_rad = 0.0;
  PoseSource tilt_source = PoseSource::kNone;  // kNone: assumed to be level, with level_sd_rad
};

class PoseEstimator {
 public:
  struct Config {
    std::optional<Geodetic> surveyed_position;  // of the origin of GROUND
    double surveyed_position_sd_m = 0.0;
    std::optional<Eigen::Vector2d> surveyed_tilt_rad;  // x, y
    double surveyed_tilt_sd_rad = 0.0;

    Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
    GnssFix least_fix = GnssFix::k3D;  // least fix that is used
    double gnss_sd_floor_m = 0.01;     // a smaller stated 1-sigma is raised to this
    double gnss_memory_s = 3600.0;     // time constant of the average
    // 1-sigma of the sensor's zero and mounting; averaging does not reduce it.
    double inclinometer_sd_rad = 2e-4;
    double inclinometer_memory_s = 60.0;  // short, to follow legs that sink into soft ground
    double level_sd_rad = 0.05;           // 1-sigma of a tilt that is not measured
    double gnss_stale_s = 10.0;
    double inclinometer_stale_s = 3.0;
    // After this time without a change of any digit, the sensor counts as stuck.
    double stuck_s = 60.0;
    double alarm_sigma = 5.0;  // a reading further off than this is inconsistent
    // Delay of the alarm, so that a gust or an outlier does not raise it.
    double alarm_after_s = 2.0;
    // After this time of inconsistent readings, the alarm asks to set up the station again.
    double restation_s = 300.0;
    // A new position is adopted after it has held for this long; 0: never.
    double accept_move_s = 0.0;
    // Growth of the position's 1-sigma while no reading is consistent.
    double growth_m_sqrt_s = 0.01;
    double growth_rad_sqrt_s = 2e-5;
    double resume_s = 7 * 86400.0;  // an older persisted pose is not resumed
  };
  explicit PoseEstimator(const Config& config);
  ~PoseEstimator();

  // Resumes the pose that was known before a restart, if there is no survey. Call it before the
  // first reading. Its sigmas grow with its age, and an alarm reports it until a sensor confirms
  // it.
  void resume(const PersistedPose& known, double now_s, std::int64_t now_utime_us);
  // The pose to save for the next start. It has only those parts that are not surveyed and that a
  // sensor has measured or confirmed since the start.
  PersistedPose to_persist(double now_s, std::int64_t now_utime_us) const;

  // Add readings in order of time for each sensor. Readings that are out of order or not finite are
  // ignored.
  void add(const GnssReading& reading);
  void add(const TiltReading& reading);

  StationPose pose(double now_s) const;
  // The conditions that hold now: "gnss: 103 m from the survey", "inclinometer: stuck".
  std::vector<Alarm> alarms(double now_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
