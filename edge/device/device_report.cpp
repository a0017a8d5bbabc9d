#include "edge/device/device_report.h"

namespace ols::device {

const char* to_string(DeviceState state) {
  switch (state) {
    case DeviceState::kAbsent:
      return "absent";
    case DeviceState::kStarting:
      return "starting";
    case DeviceState::kOk:
      return "ok";
    case DeviceState::kFault:
      return "fault";
  }
  return "unknown";
}

}  // namespace ols::device
