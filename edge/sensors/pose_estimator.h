// Estimates the position and the tilt of a station, from the survey in the configuration or, if
// there is none, from GNSS and inclinometer. Also checks whether survey and sensors agree. Pure.
//
// A tripod is stationary; readings are therefore averaged. A reading that is inconsistent with the
// pose is rejected: the pose is kept, its uncertainty grows, and an alarm states the reason. The
// uncertainty grows from the last consistent reading until the next one. It does not grow if the
// sensor has never sent a reading, unless the pose was resumed. If a tripod was moved, its heading
// is lost, too. A new position is therefore not adopted automatically, unless accept_move_s permits
// it. Instead, an alarm asks a person to set up the station again.
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

// The numerical values are those in the message station_status_t.
enum class PoseSource { kNone, kSurveyed, kSensor };

struct StationPose {
  // Position of the surveyed mark below the tripod: the origin of the frame GROUND
  // (geometry/kinematic_chain.h).
  Geodetic position;
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  // kNone: no position is known yet; the station then sends no bearings.
  PoseSource position_source = PoseSource::kNone;
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double tilt_sd_rad = 0.0;
  // kNone: the station is assumed to be level, with the 1-sigma level_sd_rad.
  PoseSource tilt_source = PoseSource::kNone;
};

class PoseEstimator {
 public:
  struct Config {
    std::optional<Geodetic> surveyed_position;  // of the origin of GROUND
    double surveyed_position_sd_m = 0.0;
    std::optional<Eigen::Vector2d> surveyed_tilt_rad;  // x, y
    double surveyed_tilt_sd_rad = 0.0;

    Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
    GnssFix least_fix = GnssFix::k3D;  // positions with a worse fix are not used
    double gnss_sd_floor_m = 0.01;     // a stated 1-sigma below this is raised to it
    double gnss_memory_s = 3600.0;     // time constant of the average of positions
    // 1-sigma of the errors of the sensor's zero and mounting, which averaging does not reduce.
    double inclinometer_sd_rad = 2e-4;
    // Time constant of the average of tilts; short, because a tripod's legs may sink into soft
    // ground.
    double inclinometer_memory_s = 60.0;
    double level_sd_rad = 0.05;  // 1-sigma of a tilt that is neither surveyed nor measured
    double gnss_stale_s = 10.0;
    double inclinometer_stale_s = 3.0;
    // The inclinometer counts as stuck if no digit of its readings has changed for this time.
    double stuck_s = 60.0;
    double alarm_sigma = 5.0;  // readings with a larger deviation are inconsistent
    // Delay of the alarm about inconsistent readings, so that a gust or an outlier does not raise
    // it.
    double alarm_after_s = 2.0;
    // After this time of inconsistent readings, the alarm asks a person to set up the station
    // again.
    double restation_s = 300.0;
    // A new position replaces the old one after readings have agreed on it for this time; 0 for
    // never.
    double accept_move_s = 0.0;
    // Growth of the 1-sigma of position and tilt while no reading is consistent: a random walk.
    double growth_m_sqrt_s = 0.01;
    double growth_rad_sqrt_s = 2e-5;
    double resume_s = 7 * 86400.0;  // a persisted pose older than this is not resumed
  };
  explicit PoseEstimator(const Config& config);
  ~PoseEstimator();

  // Resumes the pose that was known before a restart, as far as it is not surveyed. Call before the
  // first reading. The pose's sigmas grow with its age, and there is an alarm until a sensor
  // confirms it.
  void resume(const PersistedPose& known, double now_s, std::int64_t now_utime_us);
  // The pose to save for the next start. Contains only the parts that are not surveyed, and that a
  // sensor has measured or confirmed since this start.
  PersistedPose to_persist(double now_s, std::int64_t now_utime_us) const;

  // Adds a reading. The readings of each sensor must be in order of time; a reading out of order or
  // not finite is ignored.
  void add(const GnssReading& reading);
  void add(const TiltReading& reading);

  StationPose pose(double now_s) const;
  // The present alarms, for example "gnss: 103 m from the survey" or "inclinometer: stuck".
  std::vector<Alarm> alarms(double now_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
