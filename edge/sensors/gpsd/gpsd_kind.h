// The GNSS kind for receivers that gpsd reads (edge/sensors/gnss.h).
#pragma once

#include <memory>
#include <string>

#include "edge/sensors/gnss.h"
#include "edge/sensors/gpsd/gpsd_receiver.h"

namespace ols::sensors {

class GpsdKind : public GnssKind {
 public:
  config::Section section() override;
  const GnssConfig& config() const override { return gpsd; }
  bool is_configured() const override { return !gpsd.host.empty(); }
  std::string address() const override { return "gpsd at " + gpsd.host + ":" + gpsd.port; }
  std::unique_ptr<Gnss> open() const override { return std::make_unique<GpsdReceiver>(gpsd); }

  GpsdConfig gpsd;
};

}  // namespace ols::sensors
