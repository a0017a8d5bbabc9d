// The messages of a station's video socket; cuts, scales and compresses a picture as asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "edge/video/h264_encoder.h"
#include "edge/video/video_frame.h"

namespace ols::video {

// A request has no variable part; anything longer is none.
inline constexpr std::uint32_t kLargestRequest_bytes = 256;

// Empty if it is no request, or one out of range.
std::optional<VideoRequest> decode_request(std::span<const std::uint8_t> bytes);

// The answer to a request: the picture is cut, scaled and compressed here, which takes
// milliseconds. `stream`: of the viewer that has asked, for requests of H.264. Empty: the picture
// cannot be coded.
std::vector<std::uint8_t> encode_frame(const VideoFrame& frame, std::int64_t sequence,
                                       const VideoSender& sender, const VideoRequest& request,
                                       H264Encoder& stream);

}  // namespace ols::video
