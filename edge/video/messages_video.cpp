#include "edge/video/messages_video.h"

#include <cmath>
#include <limits>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/bus/message_stamp.h"
#include "ols_msg/video_frame_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "ols_msg/video_stream_request_t.hpp"

namespace ols::video {
namespace {

constexpr int kMaxWidth_px = 16384;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

void fill_rect(const cv::Rect2d& rect, double (&out)[4]) {
  out[0] = rect.x;
  out[1] = rect.y;
  out[2] = rect.width;
  out[3] = rect.height;
}

void fill_camera(const std::optional<CameraView>& camera, ols_msg::video_frame_t& message) {
  for (int i = 0; i < 3; ++i) message.camera_ecef_m[i] = camera ? camera->centre_ecef[i] : kNaN;
  for (int i = 0; i < 9; ++i) {
    message.camera_from_ecef[i] = camera ? camera->R_camera_ecef(i / 3, i % 3) : kNaN;
  }
  const CameraIntrinsics k = camera ? camera->intrinsics : CameraIntrinsics();
  const double matrix[] = {k.fx_px, k.fy_px, k.cx_px, k.cy_px, k.skew};
  const double distortion[] = {k.k1, k.k2, k.p1, k.p2, k.k3};
  for (int i = 0; i < 5; ++i) {
    message.camera_matrix_px[i] = camera ? matrix[i] : kNaN;
    message.distortion[i] = camera ? distortion[i] : kNaN;
  }
  message.lens_model = static_cast<std::int32_t>(k.model);
  message.lens_k4 = camera ? k.k4 : kNaN;
}

void fill_picture(const VideoFrame& frame, const VideoRequest& request, H264Encoder& stream,
                  ols_msg::video_frame_t& message) {
  const cv::Rect region = region_of(request, frame.gray.size());
  fill_rect(region, message.region_px);
  cv::Mat picture = frame.gray(region);
  const cv::Size size = picture_size(request, region.size());
  message.scale = static_cast<double>(size.width) / region.width;
  if (size != picture.size()) cv::resize(picture, picture, size, 0.0, 0.0, cv::INTER_AREA);
  if (request.codec == VideoCodec::kH264) {
    message.jpeg = stream.encode(picture, request.quality, request.key_frame, frame.utime_us);
  } else {
    cv::imencode(".jpg", picture, message.jpeg, {cv::IMWRITE_JPEG_QUALITY, request.quality});
  }
  message.jpeg_bytes = static_cast<std::int32_t>(message.jpeg.size());
}

// What both kinds of requests have.
template <class Message>
std::optional<VideoRequest> checked(const Message& message) {
  if (message.schema_version != Message::SCHEMA_VERSION) return std::nullopt;
  if (message.max_width_px < 1 || message.max_width_px > kMaxWidth_px) return std::nullopt;
  if (message.quality < 1 || message.quality > 100) return std::nullopt;
  for (const double edge : message.region_px) {
    if (!(std::abs(edge) <= kMaxWidth_px)) return std::nullopt;
  }
  const double(&r)[4] = message.region_px;
  return VideoRequest{
      message.after_utime, message.max_width_px, message.quality, {r[0], r[1], r[2], r[3]}};
}

}  // namespace

std::optional<VideoRequest> decode_request(std::span<const std::uint8_t> bytes) {
  const auto size = static_cast<int>(bytes.size());
  ols_msg::video_request_t message{};
  if (message.decode(bytes.data(), 0, size) == size) return checked(message);
  ols_msg::video_stream_request_t of_stream{};
  if (of_stream.decode(bytes.data(), 0, size) != size) return std::nullopt;
  auto request = checked(of_stream);
  if (!request) return std::nullopt;
  request->codec = VideoCodec::kH264;
  request->key_frame = of_stream.key_frame != 0;
  return request;
}

std::vector<std::uint8_t> encode_frame(const VideoFrame& frame, std::int64_t sequence,
                                       const VideoSender& sender, const VideoRequest& request,
                                       H264Encoder& stream) {
  ols_msg::video_frame_t message;
  stamp_message(message, frame.utime_us, sender.boot_id, sequence);
  message.station = sender.station;
  message.full_width_px = frame.gray.cols;
  message.full_height_px = frame.gray.rows;
  message.has_box = frame.box.has_value();
  fill_rect(frame.box.value_or(cv::Rect2d()), message.box_px);
  message.belief = frame.box ? frame.belief : kNaN;
  message.track_id = frame.track_id;
  fill_camera(frame.camera, message);
  fill_picture(frame, request, stream, message);
  if (message.jpeg.empty()) return {};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace ols::video
