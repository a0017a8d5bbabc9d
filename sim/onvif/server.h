// A simulated ONVIF PTZ camera on the network: serves OnvifDevice by HTTP (Boost.Beast), in a
// thread of its own.
#pragma once

#include <memory>

#include "sim/onvif/config.h"
#include "sim/ptu/device.h"

namespace ols::sim {

class OnvifServer : public PtuDevice {
 public:
  // Throws std::runtime_error if the address is not available.
  OnvifServer(const OnvifConfig& config, std::uint64_t seed);
  ~OnvifServer() override;

  int port() const;
  void set_faults(const PtuFaults& faults) override;
  PanTilt angles_at(double monotonic_s) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
