// Exceptions for cameras that cannot be used. Each contains the alarm that states the reason.
#pragma once

#include <stdexcept>

#include "conditions/alarm.h"

namespace ols::camera {

struct CameraError : std::runtime_error {
  explicit CameraError(const Alarm& why) : std::runtime_error(why.text), alarm(why) {}
  Alarm alarm;
};
struct CameraAbsent : CameraError {
  using CameraError::CameraError;
};
// The camera was found, but does not accept the configuration.
struct CameraUnfit : CameraError {
  using CameraError::CameraError;
};

}  // namespace ols::camera
