// A GNSS receiver that gpsd reads. A thread connects to gpsd through libgps, and reconnects when
// the connection is lost.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edge/sensors/gnss.h"

namespace ols::sensors {

struct GpsdConfig : GnssConfig {
  std::string host;  // host of gpsd; empty if the station has no receiver
  std::string port = "2947";
  // gpsd's errors are assumed to be this number of sigmas; used only without GST.
  double error_sigmas = 1.0;
};

class GpsdReceiver : public Gnss {
 public:
  explicit GpsdReceiver(const GpsdConfig& config);
  ~GpsdReceiver() override;
  GpsdReceiver(const GpsdReceiver&) = delete;
  GpsdReceiver& operator=(const GpsdReceiver&) = delete;

  std::vector<GnssReading> take_readings() override;
  device::DeviceReport report() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sensors
