// Where a station stands and how it leans: from the survey in the configuration where there is one,
// else from GNSS and inclinometer; and whether they agree. Pure.
//
// A tripod stands still. Readings are averaged; a reading far from what is known is not believed:
// the pose is kept, the uncertainty grows, and an alarm says why. It grows from the last reading
// that supported the pose until the next one does; a pose that no sensor ever watched does not
// grow. A tripod that was really moved has lost its heading too, so a new place is not taken over
// by itself (unless accept_move_s says so): the alarm asks for the station to be set up anew.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/sensors/gnss_reading.h"
#include "edge/sensors/persisted_pose.h"
#include "edge/sensors/tilt_reading.h"
#include "geometry/wgs84.h"

namespace ols {

enum class PoseSource { kNone, kSurveyed, kSensor };

struct StationPose {
  Geodetic position;  // of GROUND
  Eigen::Vector3d position_sd_enu_m = Eigen::Vector3d::Zero();
  PoseSource position_source = PoseSource::kNone;  // kNone: no position known yet, no bearings
  double tilt_x_rad = 0.0, tilt_y_rad = 0.0;
  double tilt_sd_rad = 0.0;
  PoseSource tilt_source = PoseSource::kNone;  // kNone: taken as level, with a sigma to match
};

class PoseEstimator {
 public:
  struct Config {
    std::optional<Geodetic> surveyed_position;  // of GROUND
    double surveyed_position_sd_m = 0.0;
    std::optional<Eigen::Vector2d> surveyed_tilt_rad;  // x, y
    double surveyed_tilt_sd_rad = 0.0;

    Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
    GnssFix least_fix = GnssFix::k3D;   // a worse one is not used
    double gnss_sd_floor_m = 0.01;      // no stated 1-sigma is believed to be smaller
    double gnss_memory_s = 3600.0;      // of the average
    double inclinometer_sd_rad = 2e-4;  // of its zero and mounting: stays
    double inclinometer_memory_s =
        60.0;                    // short: legs sink into soft ground, and that is to be seen
    double level_sd_rad = 0.05;  // of a tilt that nothing measures
    double gnss_stale_s = 10.0;
    double inclinometer_stale_s = 3.0;
    double stuck_s = 60.0;       // not a digit changes for so long: stuck
    double alarm_sigma = 5.0;    // a disagreement beyond is not believed,
    double alarm_after_s = 2.0;  // and is an alarm when it lasts: gusts and lone outliers are not
    double restation_s = 300.0;  // lasting so long, the tripod was moved
    double accept_move_s = 0.0;  // a new position that holds for so long is taken; 0: never
    double growth_m_sqrt_s = 0.01;  // of the position's 1-sigma while no reading supports it
    double growth_rad_sqrt_s = 2e-5;
    double resume_s = 7 * 86400.0;  // what is older at a restart is not taken up again
  };
  explicit PoseEstimator(const Config& config);
  ~PoseEstimator();

  // Before the first reading: what the sensors had told before a restart, where there is no survey.
  // Its sigmas have grown by its age, and an alarm tells of it, until a sensor confirms it.
  void resume(const PersistedPose& known, double now_s, std::int64_t now_utime_us);
  // What to keep over a restart: what a sensor has told, or confirmed, since this one began.
  PersistedPose to_persist(double now_s, std::int64_t now_utime_us) const;

  // In time order each; what is older than the one before, or not finite, is left out.
  void add(const GnssReading& reading);
  void add(const TiltReading& reading);

  StationPose pose(double now_s) const;
  // Conditions that hold at this instant: "gnss: 103 m from the survey", "inclinometer: stuck".
  std::vector<std::string> alarms(double now_s) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols
