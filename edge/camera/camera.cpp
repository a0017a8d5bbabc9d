#include "edge/camera/camera.h"

#include "base/clocks.h"

namespace ols::camera {

device::DeviceReport Camera::report() const {
  return make_camera_report(config_, handover_.facts(), clock_monotonic_s());
}

}  // namespace ols::camera
