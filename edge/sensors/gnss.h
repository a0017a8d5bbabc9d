// What a station needs of a GNSS receiver of any kind: its readings and its state.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "edge/device/device_report.h"
#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

// Each kind looks for its receiver in a thread of its own. After construction nothing throws.
class Gnss {
 public:
  virtual ~Gnss() = default;
  virtual std::vector<GnssReading> take_readings() = 0;  // since the last call, oldest first
  virtual device::DeviceReport report() const = 0;
};

// The configuration that all kinds have in common.
struct GnssConfig {
  double stale_s = 5.0;              // a fault after this time without a report
  GnssFix least_fix = GnssFix::k3D;  // min fix for the position
  Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
  double sd_floor_m = 0.01;    // a smaller stated 1-sigma is raised to this
  double accept_move_s = 0.0;  // a new position is adopted after holding this long; 0: never
};

std::vector<config::Row> gnss_rows(GnssConfig& config);  // of [gnss]

class GnssKind {
 public:
  virtual ~GnssKind() = default;
  virtual config::Section section() = 0;  // refers to this object
  virtual const GnssConfig& config() const = 0;
  virtual bool is_configured() const = 0;   // false: the station has no receiver
  virtual std::string address() const = 0;  // where the station looks for it, in words
  virtual std::unique_ptr<Gnss> open() const = 0;
};

}  // namespace ols::sensors
