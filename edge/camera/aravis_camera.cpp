#include "edge/camera/aravis_camera.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "edge/camera/aravis_device.h"
#include "edge/camera/frame_clock.h"
#include "edge/camera/frame_numbers.h"
#include "edge/camera/picture.h"

namespace ols {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kFirstLatches = 10;      // in a row at the start: the first frame shall have its time
constexpr double kLatchEvery_s = 1.0;  // then
constexpr double kPoll_s = 0.1;        // how soon a lost control or the end is noticed
constexpr const char* kIncomplete =
    "frame incomplete: packets were lost (no CAP_NET_RAW, or net.core.rmem_max too small?)";
constexpr double kLongestTurn_s = 2.0 * kPoll_s;  // what of a turn counts as silence

FrameClock::Config clock_config(const CameraConfig& config) {
  return {.stamp_at = config.stamp_at,
          .readout_s = config.readout_s,
          .readout_sd_s = config.readout_sd_s,
          .map = {}};
}

}  // namespace

struct AravisCamera::Impl {
  explicit Impl(const CameraConfig& config) : config_(config) {
    thread_ = std::thread([this] { run(); });
  }
  ~Impl() {
    {
      const std::lock_guard lock(mutex_);
      stop_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void run();
  void stream(AravisDevice& device);
  void close(std::unique_ptr<AravisDevice> device);
  void take(const ReceivedFrame& received, double exposure_s);
  void opened();
  void failed(CameraState state, const std::string& error);
  bool stopped() const;
  void wait(double duration_s);

  const CameraConfig config_;

  // Of the camera's thread alone.
  std::optional<FrameClock> clock_;
  FrameNumbers numbers_;
  bool opened_before_ = false;
  std::future<void> closing_;  // the last device's end, which may take seconds

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::optional<Frame> newest_;
  CameraState state_ = CameraState::kAbsent;
  CameraCounters counters_;
  std::string last_error_;

  std::thread thread_;
};

bool AravisCamera::Impl::stopped() const {
  const std::lock_guard lock(mutex_);
  return stop_;
}

void AravisCamera::Impl::wait(double duration_s) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, Seconds(duration_s), [this] { return stop_; });
}

void AravisCamera::Impl::opened() {
  const std::lock_guard lock(mutex_);
  if (opened_before_) ++counters_.reconnects;
  opened_before_ = true;
  state_ = CameraState::kStarting;
}

void AravisCamera::Impl::failed(CameraState state, const std::string& error) {
  const std::lock_guard lock(mutex_);
  state_ = state;
  last_error_ = error;
}

void AravisCamera::Impl::run() {
  while (!stopped()) {
    std::unique_ptr<AravisDevice> device;
    try {
      device = std::make_unique<AravisDevice>(config_);
      opened();
      stream(*device);
    } catch (const CameraUnfit& error) {
      failed(CameraState::kFault, error.what());
    } catch (const std::exception& error) {
      failed(CameraState::kAbsent, error.what());
    }
    if (device) close(std::move(device));
    // A camera that does not answer is asked again and again by Aravis itself, for 2.5 s.
    wait(config_.retry_s);
  }
}

// In a thread of its own: a camera that has come back is not to wait for the farewell to the one
// that was gone. One at a time.
void AravisCamera::Impl::close(std::unique_ptr<AravisDevice> device) {
  closing_ = std::async(std::launch::async, [gone = std::move(device)]() mutable { gone.reset(); });
}

void AravisCamera::Impl::stream(AravisDevice& device) {
  clock_.emplace(clock_config(config_));
  numbers_.restart();
  const auto latch = [&] {
    if (const auto sample = device.latch()) clock_->map().add_latch(*sample);
  };
  for (int i = 0; i < kFirstLatches; ++i) latch();
  const double patience_s = config_.no_frame_timeout_s + 2.0 / config_.frame_rate_hz;
  double silence_s = 0.0;
  auto last_turn = Clock::now();
  auto last_latch = last_turn;
  while (!stopped()) {
    const bool received =
        device.receive(kPoll_s, [&](const ReceivedFrame& f) { take(f, device.exposure_s()); });
    const auto now = Clock::now();
    // A turn that took longer was this process's own sleep, not the camera's.
    silence_s += std::min(Seconds(now - last_turn).count(), kLongestTurn_s);
    last_turn = now;
    if (received) silence_s = 0.0;
    const bool silent = silence_s > patience_s;
    if (silent || device.control_lost()) {
      device.give_up();
      throw CameraAbsent(silent ? "camera lost: no frame arrives"
                                : "camera lost: it no longer answers");
    }
    // Right after a frame there is time until the next one.
    if (received && Seconds(now - last_latch).count() >= kLatchEvery_s) {
      latch();
      last_latch = now;
    }
  }
}

void AravisCamera::Impl::take(const ReceivedFrame& received, double exposure_s) {
  const FrameNumbers::Step step = numbers_.next(received.id);
  if (!received.complete) {
    const std::lock_guard lock(mutex_);
    counters_.frames_lost += step.lost;
    ++counters_.frames_incomplete;
    last_error_ = kIncomplete;
    return;
  }
  const PictureFormat expected{.width_px = config_.width_px,
                               .height_px = config_.height_px,
                               .format = *pixel_format(config_.pixel_format)};
  const PictureRefusal refusal = check(received.picture, expected);
  if (refusal != PictureRefusal::kNone) {
    const std::lock_guard lock(mutex_);
    counters_.frames_lost += step.lost;
    ++counters_.frames_refused;
    state_ = CameraState::kFault;
    last_error_ = std::string("frame refused: ") + to_string(refusal);
    return;
  }
  const FrameTime time = clock_->stamp(received.device_ns, received.arrival_s, exposure_s);
  Frame frame{.gray = to_gray(received.picture),
              .mid_exposure_s = time.mid_exposure_s,
              .stamp_sd_s = time.sd_s,
              .stamp_source = time.source,
              .number = step.number};
  {
    const std::lock_guard lock(mutex_);
    counters_.frames_lost += step.lost;
    ++counters_.frames_captured;
    if (newest_) ++counters_.frames_late;
    newest_ = std::move(frame);
    state_ = CameraState::kStreaming;
  }
  changed_.notify_all();
}

AravisCamera::AravisCamera(const CameraConfig& config) : impl_(std::make_unique<Impl>(config)) {}
AravisCamera::~AravisCamera() = default;

std::optional<Frame> AravisCamera::next(double timeout_s) {
  std::unique_lock lock(impl_->mutex_);
  impl_->changed_.wait_for(lock, Seconds(timeout_s), [this] { return impl_->newest_.has_value(); });
  return std::exchange(impl_->newest_, std::nullopt);
}

CameraState AravisCamera::state() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->state_;
}

CameraCounters AravisCamera::counters() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->counters_;
}

std::string AravisCamera::last_error() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->last_error_;
}

}  // namespace ols
