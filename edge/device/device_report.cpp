#include "edge/device/device_report.h"

#include <array>

#include "base/bus/message_code.h"

namespace ols::device {

const char* to_string(DeviceState state) {
  return word_of_code(code(state), std::array{"absent", "starting", "ok", "fault"});
}

}  // namespace ols::device
