// Serves a station's pictures to permitted viewers, over TCP (docs/video.md). The answer to each
// request is the newest frame that the viewer has not had. Nothing queues, however slow a viewer or
// its network is, and nothing is compressed without a request. A thread of its own serves; the
// control loop only leaves a reference to its frame.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "edge/device/device_report.h"
#include "edge/video/video_frame.h"

namespace ols::config {
struct Section;
}
namespace ols::video {

struct VideoConfig {
  // IP address and port, "10.0.0.11:7790", "[fd00::11]:7790"; empty: no video. Viewers find it in
  // the station's status.
  std::string address;
  // Networks of the viewers, "10.0.0.0/24"; other connections are refused.
  std::vector<std::string> allow = {"127.0.0.0/8", "::1/128"};
};

config::Section video_section(VideoConfig& config);  // [video]

class VideoServer {
 public:
  // Further viewers are refused.
  static constexpr int kMaxViewers = 8;

  // Throws std::invalid_argument for a bad address or network. An address that the computer does
  // not have (yet) is retried and reported.
  VideoServer(const VideoConfig& config, VideoSender sender);
  ~VideoServer();
  VideoServer(const VideoServer&) = delete;
  VideoServer& operator=(const VideoServer&) = delete;

  // Call from any thread; none of these waits.
  // Whether anybody is connected; otherwise frames need not be offered.
  bool has_viewers() const;
  // In time order.
  void offer(VideoFrame frame);
  // The report's text is the listening address.
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::video
