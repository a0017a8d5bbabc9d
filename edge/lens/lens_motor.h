// A motorised lens on a serial port. A thread opens the port and reopens it after a failure.
#pragma once

#include <memory>

#include "edge/lens/lens_handover.h"

namespace ols::lens {

class LensMotor : public LensHandover {
 public:
  explicit LensMotor(const LensMotorConfig& config);
  ~LensMotor() override;

 private:
  struct Impl;
  device::DeviceReport line() const override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::lens
