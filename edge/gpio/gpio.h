// The station's GPIO with its own thread. The thread opens the lines, reopens them after a failure,
// and waits for their edges.
#pragma once

#include <memory>

#include "edge/gpio/gpio_handover.h"

namespace ols::gpio {

class Gpio : public GpioHandover {
 public:
  // The thread calls the two callbacks.
  Gpio(const GpioConfig& config, OnStop on_stop, OnRearm on_rearm = {});
  ~Gpio() override;

 private:
  struct Impl;
  void wake() override;

  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::gpio
