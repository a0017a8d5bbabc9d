// The exchange between the camera's thread and its callers: the newest frame, the target's box,
// trigger requests, and the camera's state. Methods may be called from any thread.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "conditions/alarm.h"
#include "edge/camera/camera_report.h"
#include "edge/camera/frame.h"
#include "edge/camera/frame_statistics.h"

namespace ols::camera {

class CameraHandover {
 public:
  // For the callers; documented in Camera.
  std::optional<Frame> next(double timeout_s);
  void set_region(const std::optional<cv::Rect2d>& target_box);
  void ask_trigger();
  CameraFacts facts() const;

  // Ends the camera's thread.
  void end();
  bool ended() const;
  // Returns after this time, or when the thread is to end.
  void wait(double duration_s);

  // For the camera's thread.
  std::optional<cv::Rect2d> region() const;
  bool take_trigger();
  template <class Change>
  void change_facts(Change change) {
    const std::lock_guard lock(mutex_);
    change(facts_);
  }
  // Takes a good frame; `lost` frames before it are missing. The frame has no pixels if a newer one
  // is already waiting.
  void publish(Frame frame, std::uint64_t lost, const FrameStatistics& statistics);
  void note_incomplete(std::uint64_t lost, const FrameStatistics& statistics);
  // Notes a complete frame that is not as configured.
  void note_refused(const std::string& why, std::uint64_t lost, const FrameStatistics& statistics);
  // Notes that the camera is lost, or cannot be opened.
  void note_failure(CameraState state, const Alarm& failure);

 private:
  void note_trouble(const std::string& what);                                   // the lock is held
  void note_statistics(std::uint64_t lost, const FrameStatistics& statistics);  // likewise

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  bool trigger_ = false;
  std::optional<Frame> newest_;
  std::optional<cv::Rect2d> region_;
  CameraFacts facts_;
};

}  // namespace ols::camera
