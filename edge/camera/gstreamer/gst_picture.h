// What cameras that are read through GStreamer have in common: its start, and pictures out of it.
#pragma once

#include <gst/gst.h>

#include <opencv2/core.hpp>
#include <optional>
#include <string>

namespace ols::camera {

// Starts GStreamer once; it starts no other program.
void start_gstreamer();

// The formats of an appsink whose pictures gst_picture() takes: planes of which the first is gray.
// With colour: one layout.
const char* gst_formats(bool with_colour);

struct GstPicture {
  cv::Mat gray;  // 8-bit, in memory of its own
  cv::Mat bgr;   // empty without colour
};
// nullopt: the sample has no picture in memory.
std::optional<GstPicture> gst_picture(GstSample* sample, bool with_colour);

// What a device says, for a line of text.
std::string printable(std::string text);

}  // namespace ols::camera
