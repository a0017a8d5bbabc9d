// What the camera's thread and its callers hand to each other: the newest frame, the target's
// place, the wish for an exposure, and how the camera is. Methods may be called from any thread.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>

#include "edge/camera/camera_report.h"
#include "edge/camera/frame.h"
#include "edge/camera/frame_statistics.h"

namespace ols::camera {

class CameraHandover {
 public:
  // For the callers; AravisCamera says what they mean.
  std::optional<Frame> next(double timeout_s);
  void set_region(const std::optional<cv::Rect2d>& target_box);
  void ask_trigger();
  CameraFacts facts() const;

  // The camera's thread shall end.
  void end();
  bool ended() const;
  // Until the end, or so long.
  void wait(double duration_s);

  // For the camera's thread.
  std::optional<cv::Rect2d> region() const;
  bool take_trigger();
  template <class Change>
  void change_facts(Change change) {
    const std::lock_guard lock(mutex_);
    change(facts_);
  }
  // A good frame after so many lost ones; without pixels when a newer one is waiting behind it.
  void publish(Frame frame, std::uint64_t lost, const FrameStatistics& statistics);
  void note_incomplete(std::uint64_t lost, const FrameStatistics& statistics);
  // A frame that is complete and not what is configured.
  void note_refused(const std::string& why, std::uint64_t lost, const FrameStatistics& statistics);
  // The camera is gone, or cannot be had.
  void note_failure(CameraState state, const std::string& what);

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
