#include "edge/camera/camera_handover.h"

#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"

namespace ols::camera {
namespace {

constexpr const char* kIncomplete =
    "frame incomplete: packets were lost (net.core.rmem_max too small? see packet_spread)";

}  // namespace

std::optional<Frame> CameraHandover::next(double timeout_s) {
  std::unique_lock lock(mutex_);
  time_source().wait(lock, changed_, timeout_s, [this] { return newest_.has_value(); });
  return std::exchange(newest_, std::nullopt);
}

void CameraHandover::set_region(const std::optional<cv::Rect2d>& target_box) {
  const std::lock_guard lock(mutex_);
  region_ = target_box;
}

void CameraHandover::ask_trigger() {
  const std::lock_guard lock(mutex_);
  trigger_ = true;
}

CameraFacts CameraHandover::facts() const {
  const std::lock_guard lock(mutex_);
  return facts_;
}

void CameraHandover::end() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  changed_.notify_all();
}

bool CameraHandover::ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

void CameraHandover::wait(double duration_s) {
  std::unique_lock lock(mutex_);
  time_source().wait(lock, changed_, duration_s, [this] { return ended_; });
}

std::optional<cv::Rect2d> CameraHandover::region() const {
  const std::lock_guard lock(mutex_);
  return region_;
}

bool CameraHandover::take_trigger() {
  const std::lock_guard lock(mutex_);
  return std::exchange(trigger_, false);
}

void CameraHandover::publish(Frame frame, std::uint64_t lost, const FrameStatistics& statistics) {
  {
    const std::lock_guard lock(mutex_);
    note_statistics(lost, statistics);
    ++facts_.counters.frames_captured;
    facts_.state = CameraState::kStreaming;
    facts_.fault = {};
    facts_.last_frame_s = clock_monotonic_s();
    facts_.stamp_source = frame.stamp_source;
    facts_.stamp_sd_s = frame.stamp_sd_s;
    if (frame.gray.empty() || newest_) ++facts_.counters.frames_late;
    if (frame.gray.empty()) return;
    newest_ = std::move(frame);
  }
  changed_.notify_all();
}

void CameraHandover::note_incomplete(std::uint64_t lost, const FrameStatistics& statistics) {
  const std::lock_guard lock(mutex_);
  note_statistics(lost, statistics);
  ++facts_.counters.frames_incomplete;
  if (facts_.incomplete_share > kManyIncomplete) note_trouble(kIncomplete);
}

void CameraHandover::note_opened(const std::string& identity, const std::string& serial) {
  const std::lock_guard lock(mutex_);
  if (facts_.opened_s) ++facts_.counters.reconnects;
  facts_.state = CameraState::kStarting;
  facts_.fault = {};
  facts_.identity = identity;
  facts_.serial = serial;
  facts_.opened_s = clock_monotonic_s();
  facts_.last_frame_s.reset();
}

void CameraHandover::note_refused(PictureRefusal why, std::uint64_t lost,
                                  const FrameStatistics& statistics) {
  const std::string words = std::string("frame refused: ") + to_string(why);
  const std::lock_guard lock(mutex_);
  note_statistics(lost, statistics);
  ++facts_.counters.frames_refused;
  facts_.state = CameraState::kFault;
  facts_.fault = alarm::camera_frames_refused(words);
  note_trouble(words);
}

void CameraHandover::note_failure(CameraState state, const Alarm& failure) {
  const std::lock_guard lock(mutex_);
  facts_.state = state;
  facts_.fault = state == CameraState::kFault ? failure : Alarm();
  facts_.frame_rate_hz = 0.0;
  facts_.incomplete_share = 0.0;
  note_trouble(failure.reason());
}

void CameraHandover::note_trouble(const std::string& what) {
  facts_.last_error = what;
  ++facts_.errors;
}

void CameraHandover::note_statistics(std::uint64_t lost, const FrameStatistics& statistics) {
  facts_.counters.frames_lost += lost;
  facts_.frame_rate_hz = statistics.rate_hz();
  facts_.incomplete_share = statistics.incomplete_share();
}

}  // namespace ols::camera
