// A GNSS receiver that gpsd reads (libgps). A thread connects to gpsd, and reconnects if the
// connection is lost.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edge/sensors/gnss.h"

namespace ols::sensors {

struct GpsdConfig : GnssConfig {
  std::string host;  // host of gpsd; empty if the station has no receiver
  std::string port = "2947";
  double error_sigmas = 1.0;  // number of sigmas in gpsd's own errors; used only without GST
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
