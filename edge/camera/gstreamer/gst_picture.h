// The common part of all cameras that are read through GStreamer: starting GStreamer, and taking
// pictures from it.
#pragma once

#include <gst/gst.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ols::camera {

// Initialises GStreamer at the first call; later calls do nothing. Prevents GStreamer from starting
// a helper process that searches for plugins.
void start_gstreamer();

// The caps that an appsink must have if its samples are passed to gst_picture(). In all of their
// formats, the first plane is the gray picture. With colour, only one format is allowed (I420).
const char* gst_formats(bool with_colour);

struct GstPicture {
  cv::Mat gray;  // 8-bit, a copy
  cv::Mat bgr;   // empty without colour
};
// Copies the picture out of a sample. nullopt if the sample has no picture in memory.
std::optional<GstPicture> gst_picture(GstSample* sample, bool with_colour);

// The first 120 bytes of a device's text, made printable in one line (base/text/plain_text.h).
std::string printable(const std::string& text);

}  // namespace ols::camera
