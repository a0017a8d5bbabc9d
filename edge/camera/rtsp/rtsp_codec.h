// The video formats of RTSP streams that a station decodes. Pure.
#pragma once

#include <string_view>

namespace ols::camera {

struct RtspCodec {
  std::string_view rtp_name;  // the name in the stream's description (SDP)
  const char* pipeline;       // GStreamer's elements from packets to pictures
};

// nullptr if the format is unknown.
const RtspCodec* rtsp_codec(std::string_view rtp_name);

// Whether stamps can count at this rate. All of these formats have 90 kHz (RFC 6184, 7798, 2435).
// Cameras whose descriptions state another usual rate are tolerated.
bool is_rtp_clock(int clock_hz);

}  // namespace ols::camera
