#include "edge/camera/v4l2/v4l2_kind.h"

#include "edge/camera/v4l2/v4l2_camera.h"

namespace ols::camera {

std::unique_ptr<Camera> V4l2Kind::open(bool keep_raw) const {
  V4l2Config config = v4l2;
  config.keep_raw = keep_raw && config.pixel_format == "BGR8";
  return std::make_unique<V4l2Camera>(config);
}

}  // namespace ols::camera
