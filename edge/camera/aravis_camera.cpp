#include "edge/camera/aravis_camera.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <future>
#include <mutex>
#include <thread>
#include <utility>

#include "base/clocks.h"
#include "edge/camera/aravis_device.h"
#include "edge/camera/exposure_log.h"
#include "edge/camera/frame_clock.h"
#include "edge/camera/frame_numbers.h"
#include "edge/camera/frame_statistics.h"
#include "edge/camera/picture.h"
#include "edge/camera/tai_reference.h"

namespace ols {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kFirstLatches = 10;      // in a row at the start: the first frame shall have its time
constexpr double kLookEvery_s = 1.0;   // at the camera's clock, then
constexpr int kTemperatureEvery = 10;  // looks
constexpr double kPoll_s = 0.1;        // how soon a lost control or the end is noticed
constexpr double kTriggerPoll_s = 0.002;  // how soon a software trigger goes out
constexpr double kLongestTurn_s = 0.2;    // what of a turn counts as silence
constexpr const char* kIncomplete =
    "frame incomplete: packets were lost (net.core.rmem_max too small? see packet_spread)";

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
  void close(std::unique_ptr<AravisDevice> device);
  void begin(AravisDevice& device);
  void stream(AravisDevice& device);
  void watch(AravisDevice& device, bool received, double turn_s);
  void look(AravisDevice& device);
  void take(const ReceivedFrame& received);
  void refuse(std::uint64_t lost, const std::string& why);
  void publish(Frame frame, std::uint64_t lost);
  void choose_exposure(const cv::Mat& gray);
  void change_exposure(AravisDevice& device);
  void trouble(const std::string& what);  // the lock is held
  void failed(CameraState state, const std::string& what);
  bool stopped() const;
  void wait(double duration_s);

  const CameraConfig config_;
  const PictureFormat expected_{.width_px = config_.width_px,
                                .height_px = config_.height_px,
                                .format = *pixel_format(config_.pixel_format)};

  // Of the camera's thread alone.
  std::optional<FrameClock> clock_;
  std::optional<ExposureLog> exposures_;
  std::optional<AutoExposure> automatic_;
  std::optional<ExposureSetting> next_exposure_;
  FrameNumbers numbers_;
  FrameStatistics statistics_;
  bool opened_before_ = false;
  double silence_s_ = 0.0;
  double looked_s_ = 0.0;
  int looks_ = 0;
  std::future<void> closing_;  // the last device's end, which may take seconds

  std::atomic<bool> trigger_ = false;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  bool stop_ = false;
  std::optional<Frame> newest_;
  std::optional<cv::Rect2d> region_;
  CameraFacts facts_;

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

void AravisCamera::Impl::trouble(const std::string& what) {
  facts_.last_error = what;
  ++facts_.errors;
}

void AravisCamera::Impl::failed(CameraState state, const std::string& what) {
  const std::lock_guard lock(mutex_);
  facts_.state = state;
  facts_.fault = state == CameraState::kFault ? what : "";
  facts_.frame_rate_hz = 0.0;
  facts_.incomplete_share = 0.0;
  trouble(what);
}

void AravisCamera::Impl::run() {
  while (!stopped()) {
    std::unique_ptr<AravisDevice> device;
    try {
      device = std::make_unique<AravisDevice>(config_);
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

void AravisCamera::Impl::begin(AravisDevice& device) {
  clock_.emplace(clock_config(config_));
  exposures_.emplace(1e-6 * device.exposure().exposure_us, 1.0 / config_.frame_rate_hz);
  automatic_.reset();
  if (config_.auto_exposure)
    automatic_.emplace(config_.auto_levels, device.limits(), device.exposure());
  next_exposure_.reset();
  numbers_.restart();
  statistics_.clear();
  silence_s_ = 0.0;
  looks_ = 0;
  const std::string identity = device.identity();
  {
    const std::lock_guard lock(mutex_);
    if (opened_before_) ++facts_.counters.reconnects;
    facts_.state = CameraState::kStarting;
    facts_.fault.clear();
    facts_.identity = identity;
    facts_.exposure = device.exposure();
    facts_.missing_light = 1.0;
    facts_.opened_s = clock_monotonic_s();
    facts_.last_frame_s.reset();
  }
  opened_before_ = true;
  for (int i = 1; i < kFirstLatches; ++i)
    if (const auto sample = device.latch()) clock_->map().add_latch(*sample);
  look(device);
}

void AravisCamera::Impl::stream(AravisDevice& device) {
  begin(device);
  const double poll_s = config_.trigger == TriggerMode::kSoftware ? kTriggerPoll_s : kPoll_s;
  auto last_turn = Clock::now();
  while (!stopped()) {
    const bool received = device.receive(poll_s, [&](const ReceivedFrame& f) { take(f); });
    const auto now = Clock::now();
    watch(device, received, Seconds(now - last_turn).count());
    last_turn = now;
    if (trigger_.exchange(false) && config_.trigger == TriggerMode::kSoftware) device.trigger();
    if (next_exposure_) change_exposure(device);
    // Right after a frame there is time until the next one.
    const bool time = received || !is_timed(config_.trigger);
    if (time && clock_monotonic_s() - looked_s_ >= kLookEvery_s) look(device);
  }
  if (is_timed(config_.trigger) && silence_s_ > kLongestTurn_s + 2.0 / config_.frame_rate_hz)
    device.give_up();  // at the end, too, a farewell that nobody hears takes seconds
}

// Throws CameraAbsent when the camera is gone.
void AravisCamera::Impl::watch(AravisDevice& device, bool received, double turn_s) {
  // A turn that took longer was this process's own sleep, not the camera's.
  silence_s_ = received ? 0.0 : silence_s_ + std::min(turn_s, kLongestTurn_s);
  const bool silent = silence_s_ > config_.no_frame_timeout_s + 2.0 / config_.frame_rate_hz;
  if (silent && !is_timed(config_.trigger) && device.answers()) {
    silence_s_ = 0.0;  // nobody has triggered it
  } else if (silent || device.control_lost()) {
    device.give_up();
    throw CameraAbsent(silent ? "camera lost: no frame arrives"
                              : "camera lost: it no longer answers");
  }
}

// At what changes slowly: the camera's clock, PTP, temperature.
void AravisCamera::Impl::look(AravisDevice& device) {
  looked_s_ = clock_monotonic_s();
  if (const auto sample = device.latch()) clock_->map().add_latch(*sample);
  std::optional<PtpState> ptp;
  if (config_.ptp != "off") {
    ptp = device.ptp().value_or(PtpState::kUnknown);
    clock_->set_tai(ptp == PtpState::kSlave
                        ? read_tai_reference(config_.tai_minus_utc_s, config_.ptp_sd_s)
                        : std::nullopt);
  }
  const bool warm = looks_++ % kTemperatureEvery == 0;
  const auto temperature_degC = warm ? device.temperature_degC() : std::nullopt;
  const std::lock_guard lock(mutex_);
  facts_.ptp = ptp;
  facts_.ptp_disagreement_s = clock_->tai_disagreement_s();
  if (warm) facts_.temperature_degC = temperature_degC;
}

void AravisCamera::Impl::take(const ReceivedFrame& received) {
  const FrameNumbers::Step step = numbers_.next(received.id);
  statistics_.add(received.complete ? received.arrival_s : clock_monotonic_s(), received.complete);
  if (!received.complete) return refuse(step.lost, "");
  const PictureRefusal refusal = check(received.picture, expected_);
  if (refusal != PictureRefusal::kNone)
    return refuse(step.lost, std::string("frame refused: ") + to_string(refusal));
  const FrameTime time = clock_->stamp(received.device_ns, received.arrival_s, *exposures_);
  Frame frame{.gray = {},
              .mid_exposure_s = time.mid_exposure_s,
              .stamp_sd_s = time.sd_s,
              .stamp_source = time.source,
              .number = step.number,
              .raw = {},
              .pixel_format = pixel_format_name(received.picture.format)};
  // Who was asleep gets the newest one, not those that have piled up.
  if (!received.overtaken) {
    frame.gray = to_gray(received.picture);
    if (config_.keep_raw) frame.raw = raw_beside_gray(received.picture);
  }
  if (automatic_ && !received.overtaken) choose_exposure(frame.gray);
  publish(std::move(frame), step.lost);
}

// `why` empty: incomplete.
void AravisCamera::Impl::refuse(std::uint64_t lost, const std::string& why) {
  const std::lock_guard lock(mutex_);
  facts_.counters.frames_lost += lost;
  facts_.incomplete_share = statistics_.incomplete_share();
  facts_.frame_rate_hz = statistics_.rate_hz();
  if (why.empty()) {
    ++facts_.counters.frames_incomplete;
  } else {
    ++facts_.counters.frames_refused;
    facts_.state = CameraState::kFault;
    facts_.fault = why;
  }
  trouble(why.empty() ? kIncomplete : why);
}

void AravisCamera::Impl::publish(Frame frame, std::uint64_t lost) {
  {
    const std::lock_guard lock(mutex_);
    facts_.counters.frames_lost += lost;
    ++facts_.counters.frames_captured;
    facts_.state = CameraState::kStreaming;
    facts_.fault.clear();
    facts_.last_frame_s = clock_monotonic_s();
    facts_.frame_rate_hz = statistics_.rate_hz();
    facts_.incomplete_share = statistics_.incomplete_share();
    facts_.stamp_source = frame.stamp_source;
    facts_.stamp_sd_s = frame.stamp_sd_s;
    if (frame.gray.empty() || newest_) ++facts_.counters.frames_late;
    if (frame.gray.empty()) return;
    newest_ = std::move(frame);
  }
  changed_.notify_all();
}

void AravisCamera::Impl::choose_exposure(const cv::Mat& gray) {
  std::optional<cv::Rect2d> region;
  {
    const std::lock_guard lock(mutex_);
    region = region_;
  }
  if (const auto next = automatic_->step(measure_levels(gray, region))) next_exposure_ = next;
}

void AravisCamera::Impl::change_exposure(AravisDevice& device) {
  const double asked_s = clock_monotonic_s();
  device.set_exposure(*std::exchange(next_exposure_, std::nullopt));
  exposures_->change(asked_s, clock_monotonic_s(), 1e-6 * device.exposure().exposure_us);
  automatic_->applied(device.exposure());
  const std::lock_guard lock(mutex_);
  facts_.exposure = device.exposure();
  facts_.missing_light = automatic_->missing_factor();
}

AravisCamera::AravisCamera(const CameraConfig& config) : impl_(std::make_unique<Impl>(config)) {}
AravisCamera::~AravisCamera() = default;

std::optional<Frame> AravisCamera::next(double timeout_s) {
  std::unique_lock lock(impl_->mutex_);
  impl_->changed_.wait_for(lock, Seconds(timeout_s), [this] { return impl_->newest_.has_value(); });
  return std::exchange(impl_->newest_, std::nullopt);
}

void AravisCamera::set_region(const std::optional<cv::Rect2d>& target_box) {
  const std::lock_guard lock(impl_->mutex_);
  impl_->region_ = target_box;
}

void AravisCamera::trigger() { impl_->trigger_ = true; }

DeviceReport AravisCamera::report() const {
  CameraFacts facts;
  {
    const std::lock_guard lock(impl_->mutex_);
    facts = impl_->facts_;
  }
  return make_camera_report(impl_->config_, facts, clock_monotonic_s());
}

CameraState AravisCamera::state() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->facts_.state;
}

CameraCounters AravisCamera::counters() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->facts_.counters;
}

std::string AravisCamera::last_error() const {
  const std::lock_guard lock(impl_->mutex_);
  return impl_->facts_.last_error;
}

}  // namespace ols
