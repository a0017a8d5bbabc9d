// A camera's description of its streams (SDP), as GStreamer reads it for the station: what is
// chosen can be decoded, and its stamps count at a possible rate.
#include <gst/sdp/gstsdpmessage.h>

#include "edge/camera/gstreamer/gst_picture.h"
#include "edge/camera/rtsp/rtsp_offer.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

namespace camera = ols::camera;

void check(const GstCaps* caps) {
  const camera::RtspOffer offer = camera::rtsp_offer(caps);
  ols::fuzz::require(offer.format.find_first_of("\n\x1b") == std::string::npos,
                     "a name is one line");
  ols::fuzz::require(g_utf8_validate(offer.format.c_str(), -1, nullptr) != FALSE, "a name is text");
  ols::fuzz::require(offer.clock_hz == 0 || camera::is_rtp_clock(offer.clock_hz),
                     "stamps count at a possible rate");
}

void check(const GstSDPMedia& media) {
  for (guint i = 0; i < gst_sdp_media_formats_len(&media); ++i) {
    const gint payload =
        static_cast<gint>(g_ascii_strtoll(gst_sdp_media_get_format(&media, i), nullptr, 10));
    GstCaps* caps = gst_sdp_media_get_caps_from_media(&media, payload);
    if (caps == nullptr) continue;
    gst_sdp_media_attributes_to_caps(&media, caps);
    check(caps);
    gst_caps_unref(caps);
  }
}

}  // namespace

// GLib keeps the names of attributes for ever, and the arrays of their pointers.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  camera::start_gstreamer();
  gst_debug_set_default_threshold(GST_LEVEL_NONE);
  GstSDPMessage* message = nullptr;
  gst_sdp_message_new(&message);
  if (gst_sdp_message_parse_buffer(data, static_cast<guint>(size), message) == GST_SDP_OK) {
    for (guint i = 0; i < gst_sdp_message_medias_len(message); ++i)
      check(*gst_sdp_message_get_media(message, i));
  }
  gst_sdp_message_free(message);
  return 0;
}
