// The interface of all kinds of GNSS receivers.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "edge/device/device_report.h"
#include "edge/sensors/gnss_reading.h"

namespace ols::sensors {

// A GNSS receiver with its own thread, which connects to the receiver. No function throws after
// construction.
class Gnss {
 public:
  virtual ~Gnss() = default;
  // Readings since the last call, oldest first.
  virtual std::vector<GnssReading> take_readings() = 0;
  virtual device::DeviceReport report() const = 0;
};

// The configuration that all kinds of receivers have in common.
struct GnssConfig {
  double stale_s = 5.0;  // after this time without a report, the receiver counts as faulty
  GnssFix least_fix = GnssFix::k3D;  // a position with a worse fix is not used
  Eigen::Vector3d ground_to_antenna_enu_m = Eigen::Vector3d::Zero();
  double sd_floor_m = 0.01;  // a stated 1-sigma below this is raised to it
  // A new position replaces the old one after readings have agreed on it for this time; 0 for
  // never.
  double accept_move_s = 0.0;
};

std::vector<config::Row> gnss_rows(GnssConfig& config);  // the common rows of the section [gnss]

class GnssKind {
 public:
  virtual ~GnssKind() = default;
  virtual config::Section section() = 0;  // binds its keys to this object's members
  virtual const GnssConfig& config() const = 0;
  virtual bool is_configured() const = 0;   // false if the station has no receiver
  virtual std::string address() const = 0;  // description of where the receiver is, for messages
  virtual std::unique_ptr<Gnss> open() const = 0;
};

}  // namespace ols::sensors
