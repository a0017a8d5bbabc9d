// The thread that owns a PTU's serial port, in real time. It opens the port, moves bytes and steps
// the driver. If the port vanishes, the thread reopens it with growing pauses.
#pragma once

#include <memory>

#include "edge/ptu/ptu_handover.h"

namespace ols::ptu {

class PtuThread : public PtuHandover {
 public:
  explicit PtuThread(const PtuConfig& config);
  ~PtuThread() override;  // sends a halt and waits briefly until it is on the line

 private:
  struct Impl;
  device::DeviceThread::Link link() const override;
  void wake() override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::ptu
