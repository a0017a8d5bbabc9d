// Serves a station's pictures to permitted viewers, over TCP (docs/video.md). Each request is
// answered with the newest frame that the viewer has not had yet. Nothing queues, however slow a
// viewer or its network is, and nothing is compressed without a request. It has its own thread; the
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
  // IP address and port, "10.0.0.11:7790" or "[fd00::11]:7790"; if empty, there is no video.
  // Viewers learn it from the station's status.
  std::string address;
  // The viewers' networks, such as "10.0.0.0/24"; connections from elsewhere are refused.
  std::vector<std::string> allow = {"127.0.0.0/8", "::1/128"};
};

config::Section video_section(VideoConfig& config);  // the section [video]

class VideoServer {
 public:
  // More viewers than this are refused.
  static constexpr int kMaxViewers = 8;

  // Throws std::invalid_argument for a bad address or network. If the computer does not have the
  // address (yet), the server reports this and tries again.
  VideoServer(const VideoConfig& config, VideoSender sender);
  ~VideoServer();
  VideoServer(const VideoServer&) = delete;
  VideoServer& operator=(const VideoServer&) = delete;

  // All functions below may be called from any thread, and none waits. has_viewers(): whether
  // anybody is connected; if not, frames need not be offered.
  bool has_viewers() const;
  // Call in order of time.
  void offer(VideoFrame frame);
  // The report's text is the listening address.
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::video
