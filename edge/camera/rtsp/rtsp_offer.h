// What a camera's description (SDP) states of one of its streams. Pure.
#pragma once

#include <gst/gst.h>

#include <string>

#include "edge/camera/rtsp/rtsp_codec.h"

namespace ols::camera {

struct RtspOffer {
  bool is_video = false;
  std::string format;                // as the camera names it, made printable
  const RtspCodec* codec = nullptr;  // null if a station cannot decode the format
  int clock_hz = 0;                  // tick rate of the stamps; 0 if it is missing or impossible
};

// `caps`: what GStreamer makes of the description.
RtspOffer rtsp_offer(const GstCaps* caps);

}  // namespace ols::camera
