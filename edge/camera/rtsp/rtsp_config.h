// The configuration of an RTSP camera. Pure.
#pragma once

#include <string>

#include "edge/camera/camera_config.h"
#include "edge/camera/rtsp/rtsp_clock.h"

namespace ols::camera {

enum class RtspTransport { kTcp, kUdp };

struct RtspConfig : CameraConfig {
  std::string url;  // without user and password; may contain {user} and {password}
  std::string user;
  // File whose first line is the password; it is read at each connection.
  std::string password_file;
  // For rtsps: the key of the camera's certificate (edge/device/certificate_key.h); if empty, the
  // certificate must be signed by an authority that this system trusts.
  std::string pinned_key;
  RtspTransport transport = RtspTransport::kTcp;
  RtspClock::Config clock;
  // Time from the exposure of the first row to that of the last row; 0 if all rows are exposed at
  // once.
  double row_readout_s = 0.0;
  double frozen_s = 20.0;  // reconnect if the picture has not changed for this time; 0 for never
  // Reconnect if no picture has come for this time plus two frame periods.
  double no_frame_timeout_s = 5.0;
  // The same limit before the first picture. This limit is longer, because decoding starts at a key
  // frame, and some cameras send a key frame only every ten seconds.
  double first_frame_timeout_s = 20.0;
  bool keep_raw = false;
};

config::Section rtsp_section(RtspConfig& config);  // the section [camera]

// The URL as it may appear in logs: "rtsp://10.0.0.5:554/...". The path is hidden, because some
// cameras need the password in the path or after it.
std::string shown_url(const std::string& url);

// The URL with {password} in place of a password that it contains, such as "pwd=secret".
std::string without_password(const std::string& url);

// The URL to connect to: {user} and {password} are replaced, percent-encoded.
std::string filled_url(const RtspConfig& config, const std::string& password);

}  // namespace ols::camera
