// The requests of a station's video viewers, and the frames that the viewers receive. Pure.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "geometry/lens.h"

namespace ols::video {

// The camera's position, direction and lens at mid-exposure.
struct CameraView {
  Eigen::Vector3d centre_ecef = Eigen::Vector3d::Zero();  // [m]
  // Rotates from ECEF to the camera's axes (OpenCV).
  Eigen::Matrix3d R_camera_ecef = Eigen::Matrix3d::Identity();
  CameraIntrinsics intrinsics;
};

// A frame with the tracker's result.
struct VideoFrame {
  std::int64_t utime_us = 0;  // mid-exposure
  cv::Mat gray;  // 8-bit, one channel; the pixels are shared with other users and never modified
  std::optional<cv::Rect2d> box;  // [px] the tracker's box in this frame
  double belief = 0.0;
  std::int64_t track_id = 0;
  std::optional<CameraView> camera;  // nullopt while the PTU's angles are unknown
};

// The sender of the frames.
struct VideoSender {
  std::string station;
  std::int64_t boot_id = 0;
};

enum class VideoCodec { kJpeg, kH264 };

struct VideoRequest {
  std::int64_t after_utime_us = 0;
  int max_width_px = 0;
  int quality = 0;  // 1..100, as for JPEG
  // [px] wanted part of the frame; a width or height of zero means the whole frame
  cv::Rect2d region = {};
  VideoCodec codec = VideoCodec::kJpeg;
  bool key_frame = false;  // for H.264: the picture must be decodable without earlier ones
};

// The requested part of a frame: all pixels of the frame that the requested rectangle touches. It
// has at least one pixel.
cv::Rect region_of(const VideoRequest& request, const cv::Size& frame);

// The size of the picture in which this region is sent. For JPEG, it is never larger than the
// region. For H.264, width and height are even numbers from 16 to 1920 pixels.
cv::Size picture_size(const VideoRequest& request, const cv::Size& region);

}  // namespace ols::video
