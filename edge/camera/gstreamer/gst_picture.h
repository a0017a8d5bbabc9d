// The common part of all cameras that are read through GStreamer: starting GStreamer, and taking
// pictures from it.
#pragma once

#include <gst/gst.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ols::camera {

// Starts GStreamer, at the first call only. GStreamer then starts no helper process to find its
// plugins.
void start_gstreamer();

// The caps that an appsink must be given for gst_picture(). In all of these formats the first plane
// is the gray picture. With colour, only one format is allowed (I420).
const char* gst_formats(bool with_colour);

struct GstPicture {
  cv::Mat gray;  // 8-bit, in memory of its own
  cv::Mat bgr;   // empty without colour
};
// nullopt: the sample has no picture in memory.
std::optional<GstPicture> gst_picture(GstSample* sample, bool with_colour);

// A device's text, made fit for one line: without control characters, and at most 120 bytes long.
std::string printable(std::string text);

}  // namespace ols::camera
