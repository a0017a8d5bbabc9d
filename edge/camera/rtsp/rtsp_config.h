// The configuration of an RTSP camera. Pure.
#pragma once

#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/rtsp/rtsp_clock.h"

namespace ols::camera {

enum class RtspTransport { kTcp, kUdp };

struct RtspConfig : CameraConfig {
  std::string url;  // without user and password
  std::string user;
  std::string password_file;  // its first line; read at each connection
  RtspTransport transport = RtspTransport::kTcp;
  RtspClock::Config clock;
  double row_readout_s = 0.0;       // from the first to the last row of a picture; 0: all at once
  double frozen_s = 20.0;           // the same picture for so long: connected anew; 0: never
  double no_frame_timeout_s = 5.0;  // plus two frame periods: connected anew
  double first_frame_timeout_s = 20.0;  // a camera may send a whole picture every ten seconds only
  bool keep_raw = false;
};

config::Section rtsp_section(RtspConfig& config);  // of [camera]

// "rtsp://10.0.0.5:554/...": for logs; some cameras want the password in the path or behind it.
std::string shown_url(const std::string& url);

}  // namespace ols::camera
