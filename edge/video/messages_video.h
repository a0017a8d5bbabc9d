// The messages of a station's video socket. Crops, scales and compresses a picture as requested.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "edge/video/h264_encoder.h"
#include "edge/video/video_frame.h"

namespace ols::video {

// A request has no variable part; a longer message is not a request.
inline constexpr std::uint32_t kLargestRequest_bytes = 256;

// nullopt if it is not a request, or out of range.
std::optional<VideoRequest> decode_request(std::span<const std::uint8_t> bytes);

// Makes the answer to a request. Cropping, scaling and compressing take milliseconds. `stream`: the
// encoder of the requesting viewer, for H.264. Returns empty if the picture cannot be coded.
std::vector<std::uint8_t> encode_frame(const VideoFrame& frame, std::int64_t sequence,
                                       const VideoSender& sender, const VideoRequest& request,
                                       H264Encoder& stream);

}  // namespace ols::video
