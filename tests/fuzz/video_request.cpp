// What a viewer may send to a station's video socket. Whatever is taken for a request means a
// region within any frame, and its answer decodes.
#include "edge/video/messages_video.h"
#include "ols_msg/video_frame_t.hpp"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto request = ols::video::decode_request({data, size});
  if (!request) return 0;
  static const cv::Mat kGray(48, 64, CV_8U, cv::Scalar(100));
  ols::video::VideoFrame frame;
  frame.gray = kGray;
  const cv::Rect region = ols::video::region_of(*request, kGray.size());
  ols::fuzz::require(!region.empty(), "the region has a pixel");
  ols::fuzz::require((region & cv::Rect({0, 0}, kGray.size())) == region, "and is in the frame");
  ols::video::H264Encoder stream;
  const auto bytes = ols::video::encode_frame(frame, 1, {"a", 1}, *request, stream);
  ols::fuzz::require(!bytes.empty(), "any picture can be coded");
  ols_msg::video_frame_t answer;
  const auto length = static_cast<int>(bytes.size());
  ols::fuzz::require(answer.decode(bytes.data(), 0, length) == length, "the answer decodes");
  return 0;
}
