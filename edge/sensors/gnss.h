// What a station needs from a GNSS receiver of any kind: its readings and its state.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "edge/device/device_report.h"
#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

// Each kind searches for its receiver in its own thread. Nothing throws after construction.
class Gnss {
 public:
  virtual ~Gnss() = default;
  virtual std::vector<GnssReading> take_readings() = 0;  // those since the last call, oldest first
  virtual device::DeviceReport report() const = 0;
};

// The configuration that all kinds have in common.
struct GnssConfig {
  double stale_s = 5.0;  // after this time without a report, the receiver counts as faulty
  GnssFix least_fix = GnssFix::k3D;  // least fix with which a position is used
  Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
  double sd_floor_m = 0.01;  // a smaller stated 1-sigma is raised to this
  // A new position is adopted after it has held for this long; 0: never.
  double accept_move_s = 0.0;
};

std::vector<config::Row> gnss_rows(GnssConfig& config);  // rows of the section [gnss]

class GnssKind {
 public:
  virtual ~GnssKind() = default;
  virtual config::Section section() = 0;  // its rows write into this object
  virtual const GnssConfig& config() const = 0;
  virtual bool is_configured() const = 0;   // false if the station has no receiver
  virtual std::string address() const = 0;  // where the station searches for it, in words
  virtual std::unique_ptr<Gnss> open() const = 0;
};

}  // namespace ols::sensors
