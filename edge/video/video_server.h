// Serves a station's pictures to permitted viewers, over TCP (docs/video.md). It answers each
// request with the newest frame. If the viewer already has this frame, the answer waits for the
// next one. Pictures never queue, however slow a viewer or its network is, and a picture is
// compressed only on request. The server has its own thread; the control loop only hands over a
// reference to its newest frame.
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
  // IP address and port to listen at, "10.0.0.11:7790" or "[fd00::11]:7790"; if empty, there is no
  // video. Viewers find the address in the station's status.
  std::string address;
  // The viewers' networks, such as "10.0.0.0/24"; connections from elsewhere are refused.
  std::vector<std::string> allow = {"127.0.0.0/8", "::1/128"};
};

config::Section video_section(VideoConfig& config);  // the section [video]

class VideoServer {
 public:
  // Maximum number of viewers at a time; others are refused.
  static constexpr int kMaxViewers = 8;

  // Throws std::invalid_argument if the address or a network is malformed. If the computer does not
  // have the address (yet), the server reports this and tries again.
  VideoServer(const VideoConfig& config, VideoSender sender);
  ~VideoServer();
  VideoServer(const VideoServer&) = delete;
  VideoServer& operator=(const VideoServer&) = delete;

  // All functions below may be called from any thread, and none waits. has_viewers() returns
  // whether a viewer is connected; if not, the caller need not offer frames.
  bool has_viewers() const;
  // Offers a frame to the viewers. Call in order of time.
  void offer(VideoFrame frame);
  // The `text` in the report is the address at which the server listens.
  device::DeviceReport report() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::video
