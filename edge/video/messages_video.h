// The messages on a station's video connections: decodes a viewer's request, and encodes the
// answer.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "edge/video/h264_encoder.h"
#include "edge/video/video_frame.h"

namespace ols::video {

// All requests are shorter than this, because they have a fixed length. A longer message is
// refused.
inline constexpr std::uint32_t kLargestRequest_bytes = 256;

// nullopt if the bytes are not a request, or if a value is out of range.
std::optional<VideoRequest> decode_request(std::span<const std::uint8_t> bytes);

// Makes the answer to a request: crops, scales and compresses the frame, which takes milliseconds.
// `sequence`: number of the frame. `stream`: the H.264 encoder of the requesting viewer. Returns an
// empty vector if the picture cannot be coded.
std::vector<std::uint8_t> encode_frame(const VideoFrame& frame, std::int64_t sequence,
                                       const VideoSender& sender, const VideoRequest& request,
                                       H264Encoder& stream);

}  // namespace ols::video
