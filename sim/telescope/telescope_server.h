// A simulated telescope mount behind an INDI server, on the network, in a thread of its own.
#pragma once

#include <memory>

#include "sim/ptu/device.h"
#include "sim/telescope/telescope.h"

namespace ols::sim {

class TelescopeServer : public PtuDevice {
 public:
  // Throws std::runtime_error if the address is not available.
  TelescopeServer(const TelescopeConfig& config, std::uint64_t seed);
  ~TelescopeServer() override;

  int port() const;
  void set_faults(const PtuFaults& faults) override;
  PanTilt angles_at(double monotonic_s) override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
