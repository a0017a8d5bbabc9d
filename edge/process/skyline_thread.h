// Compares pictures with the skyline of the land in its own thread, with lower priority than the
// control loop.
#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "edge/skyline/skyline_watch.h"
#include "edge/video/video_frame.h"
#include "geometry/kinematic_chain.h"

namespace ols::station {

class SkylineThread {
 public:
  explicit SkylineThread(std::shared_ptr<const land::Surface> land);
  ~SkylineThread() = default;  // waits for the picture that is being compared
  SkylineThread(const SkylineThread&) = delete;
  SkylineThread& operator=(const SkylineThread&) = delete;

  // Whether a picture is wanted: some seconds after the last one, while the unit stands still.
  bool wants(double now_s, const PanTilt& reported);
  // Never waits. `picture` needs a camera.
  void give(video::VideoFrame picture);
  // Forgets what has been seen, because the station's heading or reference has changed.
  void forget();
  Alarm alarm() const;

 private:
  void work(const std::stop_token& stop);

  skyline::SkylineWatch watch_;
  double due_s_ = 0.0;
  PanTilt before_;  // as reported at the picture before
  mutable std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::optional<video::VideoFrame> picture_;
  bool works_ = false;    // a picture is waiting or being compared
  bool forgets_ = false;  // before the next picture
  Alarm alarm_;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::station
