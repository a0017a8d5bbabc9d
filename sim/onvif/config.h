// The configuration of a simulated ONVIF PTZ camera.
#pragma once

#include <string>

#include "sim/onvif/ptz_unit.h"

namespace ols::sim {

struct OnvifConfig {
  std::string address = "127.0.0.1";  // of the network interface to use
  int port = 8080;                    // 0: any
  std::string user = "admin", password = "ptz-camera";
  std::string serial = "1";
  std::string stream_uri;  // the address of its video, which the camera gives to clients
  int width_px = 1280, height_px = 960;
  double frame_rate_hz = 25.0;
  std::string encoding = "H264";  // or "H265", which only the service Media2 can name
  PtzUnitConfig unit;
};

}  // namespace ols::sim
