#include "edge/camera/rtsp/rtsp_codec.h"

#include <algorithm>
#include <array>

namespace ols::camera {
namespace {

// One thread, because a picture per thread would wait in the decoder.
constexpr std::array<RtspCodec, 3> kCodecs{{
    {"H264",
     "rtph264depay ! video/x-h264,alignment=au ! h264parse ! avdec_h264 name=decoder "
     "max-threads=1"},
    {"H265",
     "rtph265depay ! video/x-h265,alignment=au ! h265parse ! avdec_h265 name=decoder "
     "max-threads=1"},
    {"JPEG", "rtpjpegdepay ! jpegdec name=decoder"},
}};

}  // namespace

const RtspCodec* rtsp_codec(std::string_view rtp_name) {
  const auto* const codec = std::ranges::find(kCodecs, rtp_name, &RtspCodec::rtp_name);
  return codec == kCodecs.end() ? nullptr : codec;
}

bool is_rtp_clock(int clock_hz) {
  constexpr int kLeast_hz = 1'000, kMost_hz = 100'000'000;
  return clock_hz >= kLeast_hz && clock_hz <= kMost_hz;
}

}  // namespace ols::camera
