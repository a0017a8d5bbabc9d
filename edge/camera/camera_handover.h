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
#include "edge/camera/picture.h"

namespace ols::camera {

class CameraHandover {
 public:
  // For the callers; Camera describes these functions.
  std::optional<Frame> next(double timeout_s);
  void set_region(const std::optional<cv::Rect2d>& target_box);
  void ask_trigger();
  CameraFacts facts() const;

  // Requests the end of the camera's thread.
  void end();
  bool ended() const;
  // Waits for this time, but not longer than until end() is called.
  void wait(double duration_s);

  // For the camera's thread.
  std::optional<cv::Rect2d> region() const;
  bool take_trigger();
  template <class Change>
  void change_facts(Change change) {
    const std::lock_guard lock(mutex_);
    change(facts_);
  }
  // Hands over a complete frame of the configured size and format. If a newer frame is already
  // waiting, this one may come without pixels; it is then only counted. `lost`, here and below:
  // number of frames missing before this one.
  void publish(Frame frame, std::uint64_t lost, const FrameStatistics& statistics);
  // Notes that the camera was opened and has not sent a frame yet.
  void note_opened(const std::string& identity, const std::string& serial = {});
  void note_incomplete(std::uint64_t lost, const FrameStatistics& statistics);
  // Notes a complete frame whose size or format differs from the configuration.
  void note_refused(PictureRefusal why, std::uint64_t lost, const FrameStatistics& statistics);
  // Notes that the camera is lost, or cannot be opened.
  void note_failure(CameraState state, const Alarm& failure);

 private:
  void note_trouble(const std::string& what);  // the caller holds the lock
  // The caller holds the lock.
  void note_statistics(std::uint64_t lost, const FrameStatistics& statistics);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool ended_ = false;
  bool trigger_ = false;
  std::optional<Frame> newest_;
  std::optional<cv::Rect2d> region_;
  CameraFacts facts_;
};

}  // namespace ols::camera
