// A FLIR unit on a serial port. Its thread opens the port, reads and writes bytes, and calls the
// driver. If the port vanishes, the thread reopens it, with growing pauses.
#pragma once

#include <memory>

#include "edge/ptu/ptu_handover.h"

namespace ols::ptu {

class PtuThread : public PtuHandover {
 public:
  explicit PtuThread(const PtuConfig& config);
  ~PtuThread() override;  // sends a halt and waits a short time until the halt has been sent

 private:
  struct Impl;
  device::DeviceThread::Link link() const override;
  void wake() override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::ptu
