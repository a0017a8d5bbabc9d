// One connection to an RTSP camera: GStreamer receives and decodes in threads of its own; a caller
// takes the newest picture.
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

// The camera refuses user or password.
struct LoginRefused : CameraError {
  using CameraError::CameraError;
};

struct DecodedPicture {
  cv::Mat gray;  // 8 bits, its own memory
  cv::Mat bgr;   // empty where nobody needs it
  RtpPicture rtp;
};

class RtspStream {
 public:
  // Begins to connect, and returns at once. Throws CameraUnfit if parts of GStreamer are missing.
  RtspStream(const RtspConfig& config, const std::string& password);
  ~RtspStream();
  RtspStream(const RtspStream&) = delete;
  RtspStream& operator=(const RtspStream&) = delete;

  // The newest picture; empty: none came in time. Throws CameraAbsent when the stream has ended,
  // CameraUnfit if it has no video that can be decoded, LoginRefused.
  std::optional<DecodedPicture> receive(double timeout_s);

  std::string codec() const;  // "H264"; empty: not known yet
  std::uint64_t lost_packets() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::camera
