#include "edge/camera/rtsp/rtsp_offer.h"

#include "edge/camera/gstreamer/gst_picture.h"

namespace ols::camera {
namespace {

std::string value_of(const GstStructure* structure, const char* field) {
  const char* text = gst_structure_get_string(structure, field);
  return text == nullptr ? "" : text;
}

}  // namespace

RtspOffer rtsp_offer(const GstCaps* caps) {
  RtspOffer offer;
  if (gst_caps_is_any(caps) != FALSE || gst_caps_get_size(caps) == 0) return offer;
  const GstStructure* structure = gst_caps_get_structure(caps, 0);
  const std::string format = value_of(structure, "encoding-name");
  offer.is_video = value_of(structure, "media") == "video";
  offer.format = printable(format);
  offer.codec = rtsp_codec(format);
  gint clock_hz = 0;
  if (gst_structure_get_int(structure, "clock-rate", &clock_hz) != FALSE && is_rtp_clock(clock_hz))
    offer.clock_hz = clock_hz;
  return offer;
}

}  // namespace ols::camera
