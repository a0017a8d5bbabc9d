// A simulated IP camera: serves its pictures by RTSP. Its RTCP sender reports give the time of the
// camera's own clock. While a client is connected, a callback draws the pictures.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <string>

#include "sim/camera/simulated_camera.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

enum class VideoCodec { kH264, kH265, kJpeg };

struct RtspServerConfig {
  std::string address;         // of the network interface to use
  int port = 8554;             // 0: any
  std::string user, password;  // empty: no login
  std::string certificate;     // PEM with the private key, for rtsps; empty: rtsp
  VideoCodec codec = VideoCodec::kH264;
  int width_px = 1280, height_px = 960;
  double frame_rate_hz = 25.0;
  double exposure_s = 0.005;
  double delay_s = 0.05;  // from the end of the exposure to the encoder
  int key_every = 25;     // [pictures] distance between key frames
  int kbit_s = 8000;
};

class RtspServer {
 public:
  // `draw` fills an 8-bit gray image; called in the camera's own thread. Throws std::runtime_error
  // if the address is not available or a GStreamer plugin is missing.
  RtspServer(const RtspServerConfig& config, std::function<void(const Exposure&, cv::Mat&)> draw);
  ~RtspServer();

  std::string url() const;  // "rtsp://127.0.0.1:8554/video"
  // From now on, the camera sends pictures of another size, as after a change of its settings.
  void set_size(int width_px, int height_px);
  void set_faults(const CameraFaults& faults);
  // Number of connections since the start.
  int connections() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
