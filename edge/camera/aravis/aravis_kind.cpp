#include "edge/camera/aravis/aravis_kind.h"

#include "edge/camera/aravis/aravis_camera.h"

namespace ols::camera {

std::unique_ptr<Camera> AravisKind::open(bool keep_raw) const {
  AravisConfig config = aravis;
  config.keep_raw = keep_raw;
  return std::make_unique<AravisCamera>(config);
}

}  // namespace ols::camera
