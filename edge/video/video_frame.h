// What a viewer of a station's camera gets and asks for. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "geometry/pinhole.h"

namespace ols::video {

// The camera at mid-exposure.
struct CameraView {
  Eigen::Vector3d centre_ecef = Eigen::Vector3d::Zero();        // [m]
  Eigen::Matrix3d R_camera_ecef = Eigen::Matrix3d::Identity();  // OpenCV's axes
  CameraIntrinsics intrinsics;
};

// A frame as the station saw it, with what its tracker said of it.
struct VideoFrame {
  std::int64_t utime_us = 0;      // mid-exposure
  cv::Mat gray;                   // 8-bit, one channel; its pixels are shared and never written
  std::optional<cv::Rect2d> box;  // [px] of the tracker in this frame
  double belief = 0.0;
  std::int64_t track_id = 0;
  std::optional<CameraView> camera;  // empty while the PTU's angles are unknown
};

// Who sends it.
struct VideoSender {
  std::string station;
  std::int64_t boot_id = 0;
};

enum class VideoCodec { kJpeg, kH264 };

struct VideoRequest {
  std::int64_t after_utime_us = 0;
  int max_width_px = 0;
  int quality = 0;         // 1..100, of JPEG
  cv::Rect2d region = {};  // [px]; without width: the whole frame
  VideoCodec codec = VideoCodec::kJpeg;
  bool key_frame = false;  // of H.264: decodable without what came before
};

// The part of a frame that a request means, in whole pixels and within the frame; at least one
// pixel.
cv::Rect region_of(const VideoRequest& request, const cv::Size& frame);

// How large the picture of such a region becomes: never larger than the region, but for H.264,
// whose pictures have even sides of at least 16 pixels, and at most 1920.
cv::Size picture_size(const VideoRequest& request, const cv::Size& region);

}  // namespace ols::video
