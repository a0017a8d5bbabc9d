// Runs the detector in its own thread, with lower priority than the control loop, because the
// detector needs tens of milliseconds for a picture.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <stop_token>
#include <thread>

#include "edge/detector/detector_work.h"

namespace ols::station {

class DetectorThread {
 public:
  explicit DetectorThread(const detector::DetectorConfig& config);
  ~DetectorThread() = default;  // waits until the detector has finished its current picture
  DetectorThread(const DetectorThread&) = delete;
  DetectorThread& operator=(const DetectorThread&) = delete;

  // Hands a picture to the thread; never waits. Call it again only after take() has returned the
  // result of the previous picture.
  void give(detector::Picture picture);
  std::optional<detector::Found> take();
  double picture_s() const { return picture_s_; }  // processing time of a picture, smoothed

 private:
  void work(const std::stop_token& stop);

  detector::PictureDetector detector_;
  std::mutex mutex_;
  std::condition_variable_any arrived_;
  std::condition_variable found_;
  std::optional<detector::Picture> picture_;
  bool works_ = false;  // a picture is waiting or being processed
  std::optional<detector::Found> result_;
  double taken_s_ = 0.0, picture_s_ = 0.0;
  std::jthread thread_;  // last member, because it uses the others
};

}  // namespace ols::station
