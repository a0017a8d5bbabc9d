// Why a camera cannot be used: an alarm as text (conditions/alarms.h).
#pragma once

#include <stdexcept>

namespace ols::camera {

struct CameraAbsent : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Found, but it does not accept the configuration.
struct CameraUnfit : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ols::camera
