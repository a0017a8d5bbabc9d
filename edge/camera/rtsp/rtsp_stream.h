// One connection to an RTSP camera. GStreamer receives and decodes the pictures in its own threads;
// receive() returns the newest one.
#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "edge/camera/camera_errors.h"
#include "edge/camera/rtsp/rtp_pictures.h"
#include "edge/camera/rtsp/rtsp_config.h"

namespace ols::camera {

// The camera has refused the user or the password.
struct LoginRefused : CameraError {
  using CameraError::CameraError;
};

struct DecodedPicture {
  cv::Mat gray;  // 8-bit, a copy
  cv::Mat bgr;   // empty unless the configuration has keep_raw
  RtpPicture rtp;
};

class RtspStream {
 public:
  // Begins to connect, and returns at once. Throws CameraUnfit if parts of GStreamer are missing.
  RtspStream(const RtspConfig& config, const std::string& password);
  ~RtspStream();
  RtspStream(const RtspStream&) = delete;
  RtspStream& operator=(const RtspStream&) = delete;

  // Waits for a new picture and returns the newest one; nullopt if none came in time. Throws
  // CameraAbsent if the stream has ended, CameraUnfit if it contains no video that can be decoded,
  // and LoginRefused.
  std::optional<DecodedPicture> receive(double timeout_s);

  std::string codec() const;  // for example "H264"; empty if not known yet
  std::uint64_t lost_packets() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
