#include "edge/camera/gstreamer/gst_picture.h"

#include <gst/video/video.h>

#include <opencv2/imgproc.hpp>

#include "base/text/plain_text.h"

namespace ols::camera {
namespace {

cv::Mat plane(const GstVideoFrame& frame, int index, int rows, int columns) {
  // cv::Mat takes no const pointer; nothing writes through it.
  return {rows, columns, CV_8U, GST_VIDEO_FRAME_PLANE_DATA(&frame, index),
          static_cast<std::size_t>(GST_VIDEO_FRAME_PLANE_STRIDE(&frame, index))};
}

// The planes one after the other, as OpenCV wants them.
cv::Mat bgr_of(const GstVideoFrame& frame, int rows, int columns) {
  cv::Mat planes(rows * 3 / 2, columns, CV_8U);
  plane(frame, 0, rows, columns).copyTo(planes.rowRange(0, rows));
  std::uint8_t* to = planes.ptr(rows);
  for (int index : {1, 2}) {
    cv::Mat chroma(rows / 2, columns / 2, CV_8U, to + (index - 1) * (rows / 2) * (columns / 2));
    plane(frame, index, rows / 2, columns / 2).copyTo(chroma);
  }
  cv::Mat bgr;
  cv::cvtColor(planes, bgr, cv::COLOR_YUV2BGR_I420);
  return bgr;
}

}  // namespace

void start_gstreamer() {
  static const bool kStarted = [] {
    gst_registry_fork_set_enabled(FALSE);  // the station starts no other program
    gst_init(nullptr, nullptr);
    return true;
  }();
  static_cast<void>(kStarted);
}

const char* gst_formats(bool with_colour) {
  return with_colour ? "video/x-raw,format=I420" : "video/x-raw,format={I420,NV12,Y42B,Y444,GRAY8}";
}

std::optional<GstPicture> gst_picture(GstSample* sample, bool with_colour) {
  GstBuffer* buffer = gst_sample_get_buffer(sample);
  GstVideoInfo info;
  GstVideoFrame frame;
  if (gst_video_info_from_caps(&info, gst_sample_get_caps(sample)) == FALSE ||
      gst_video_frame_map(&frame, &info, buffer, GST_MAP_READ) == FALSE)
    return std::nullopt;
  const int rows = GST_VIDEO_FRAME_HEIGHT(&frame), columns = GST_VIDEO_FRAME_WIDTH(&frame);
  GstPicture picture{plane(frame, 0, rows, columns).clone(), {}};
  if (with_colour && rows % 2 == 0 && columns % 2 == 0) picture.bgr = bgr_of(frame, rows, columns);
  gst_video_frame_unmap(&frame);
  return picture;
}

std::string printable(const std::string& text) {
  constexpr std::size_t kMostBytes = 120;
  return plain_text(text.substr(0, kMostBytes));
}

}  // namespace ols::camera
