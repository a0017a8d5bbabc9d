#include "edge/camera/rtsp/rtsp_kind.h"

#include "edge/camera/rtsp/rtsp_camera.h"

namespace ols::camera {

std::unique_ptr<Camera> RtspKind::open(bool keep_raw) const {
  RtspConfig config = rtsp;
  config.keep_raw = keep_raw && config.pixel_format == "BGR8";
  return std::make_unique<RtspCamera>(config);
}

}  // namespace ols::camera
