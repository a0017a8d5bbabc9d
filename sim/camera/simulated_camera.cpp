#include "sim/camera/simulated_camera.h"

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>
#include <utility>

#include "base/process/clocks.h"
#include "sim/camera/exposure_cue.h"
#include "sim/camera/gige_control.h"
#include "sim/camera/gige_device.h"
#include "sim/camera/gige_registers.h"
#include "sim/camera/gige_sensor.h"
#include "sim/camera/gige_stream.h"

namespace ols::sim {
namespace {

using Clock = ExposureCue::Clock;

constexpr auto kHeartbeatCheck = std::chrono::milliseconds(200);
constexpr std::uint64_t kFrameIds = 65535;
constexpr std::uint64_t kFirstId = 65400;  // wraps soon, to test the client early

double seconds(Clock::time_point time) {
  return std::chrono::duration<double>(time.time_since_epoch()).count();
}

Clock::duration duration(double seconds_) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds_));
}

std::int64_t nanoseconds(Clock::time_point time) {
  return std::chrono::nanoseconds(time.time_since_epoch()).count();
}

bool is_timed(Trigger trigger) {
  return trigger == Trigger::kFreerun || trigger == Trigger::kFixedRate;
}

}  // namespace

struct SimulatedCamera::Impl {
  Impl(const SimulatedCameraConfig& config, std::function<void(const Exposure&, cv::Mat&)> draw);
  ~Impl();

  void answer(gige::Bytes packet, std::uint64_t peer, const GigeControl::Reply& reply);
  void run_stream();
  std::optional<Clock::time_point> next_start(const StreamSettings& settings);
  void expose(const StreamSettings& settings, Clock::time_point start);
  // The camera's clock at an instant: its own, or that of the PTP master.
  std::int64_t device_ns(Clock::time_point time);

  const SimulatedCameraConfig config_;
  const std::function<void(const Exposure&, cv::Mat&)> draw_;
  const Clock::time_point switched_on_ = Clock::now();
  GigeDevice device_;
  GigeStream stream_;

  // only the stream thread's
  std::uint64_t frames_ = 0;
  std::optional<Clock::time_point> last_start_;
  cv::Mat gray_;

  std::atomic<std::uint64_t> skipped_ = 0;
  std::atomic<bool> gone_ = false;

  ExposureCue cue_;
  std::thread stream_thread_;
  GigeControl control_;  // last: it uses the rest
};

SimulatedCamera::Impl::Impl(const SimulatedCameraConfig& config,
                            std::function<void(const Exposure&, cv::Mat&)> draw)
    : config_(config),
      draw_(std::move(draw)),
      device_({.serial = config.serial,
               .address = camera_address(config.address),
               .width_px = config.width_px,
               .height_px = config.height_px,
               .exposure_s = config.exposure_s,
               .names = config.names,
               .tick_frequency = config.tick_frequency}),
      stream_(camera_address(config.address)),
      control_(config.address,
               [this](gige::Bytes packet, std::uint64_t peer, const GigeControl::Reply& reply) {
                 answer(packet, peer, reply);
               }) {
  stream_thread_ = std::thread([this] { run_stream(); });
}

SimulatedCamera::Impl::~Impl() {
  cue_.end();
  stream_thread_.join();
}

void SimulatedCamera::Impl::answer(gige::Bytes packet, std::uint64_t peer,
                                   const GigeControl::Reply& reply) {
  if (gone_) return;
  const auto now = Clock::now();
  const Answer answer = device_.handle(packet, peer, device_ns(now), seconds(now));
  if (!answer.acknowledgement.empty()) reply(answer.acknowledgement);
  if (answer.resend) stream_.resend(*answer.resend);
  if (answer.trigger) cue_.trigger(Trigger::kSoftware);
  cue_.client_spoke();
}

std::int64_t SimulatedCamera::Impl::device_ns(Clock::time_point time) {
  if (device_.ptp_slave(seconds(time))) {
    const std::int64_t utc_ns = clock_utc_ns() - (nanoseconds(Clock::now()) - nanoseconds(time));
    return utc_ns + std::llround(1e9 * config_.tai_minus_utc_s);
  }
  const auto age_ns = static_cast<double>(nanoseconds(time) - nanoseconds(switched_on_));
  return 1'000'000'000 + std::llround(age_ns * (1.0 + 1e-6 * config_.clock_drift_ppm));
}

// The start of the next exposure; nullopt while it is unknown. Waits briefly for a trigger.
std::optional<Clock::time_point> SimulatedCamera::Impl::next_start(const StreamSettings& settings) {
  const auto period = duration(settings.period_s);
  if (is_timed(settings.trigger)) return last_start_ ? *last_start_ + period : Clock::now();
  const auto triggered = cue_.wait_for_trigger(kHeartbeatCheck);
  if (!triggered || triggered->first != settings.trigger) return std::nullopt;
  const auto start = triggered->second + duration(settings.trigger_delay_s);
  // It ignores triggers while busy with the last exposure.
  if (last_start_ && start < *last_start_ + period) return std::nullopt;
  return start;
}

void SimulatedCamera::Impl::run_stream() {
  for (;;) {
    auto settings = device_.streaming(seconds(Clock::now()));
    if (!settings) {
      last_start_.reset();
      if (cue_.wait_for_client(kHeartbeatCheck)) return;
      continue;
    }
    const auto start = next_start(*settings);
    if (cue_.wait_until(start.value_or(Clock::now()))) return;
    if (!start) continue;
    // The settings at the start of the exposure apply.
    settings = device_.streaming(seconds(Clock::now()));
    if (!settings) continue;
    const auto until_drawn = duration(settings->exposure_s + config_.readout_s);
    if (cue_.wait_until(*start + until_drawn)) return;
    if (!device_.streaming(seconds(Clock::now()))) continue;
    last_start_ = start;
    expose(*settings, *start);
    const auto period = duration(settings->period_s);
    if (!is_timed(settings->trigger)) continue;
    for (const auto now = Clock::now(); *last_start_ + period + until_drawn + period < now;) {
      *last_start_ += period;
      ++skipped_;
    }
  }
}

void SimulatedCamera::Impl::expose(const StreamSettings& settings, Clock::time_point start) {
  if (gone_) {
    ++frames_;  // the camera continues behind the cut line until its heartbeat times out
    return;
  }
  const Exposure exposure{.start_monotonic_ns = nanoseconds(start),
                          .exposure_s = settings.exposure_s,
                          .gain_dB = settings.gain_dB,
                          .frame = frames_};
  const int width = static_cast<int>(settings.width), height = static_cast<int>(settings.height);
  cv::Mat raw = stream_.blank(width, height, gige::picture_type(settings.format));
  if (settings.format == gige::kMono8) {
    draw_(exposure, raw);
  } else {
    gray_.create(height, width, CV_8UC1);
    draw_(exposure, gray_);
    gige::develop(gray_, kTint, settings.format, raw);
  }
  const gige::Picture description{
      .id = static_cast<std::uint16_t>((kFirstId - 1 + frames_) % kFrameIds + 1),
      .stamp = static_cast<std::uint64_t>(device_ns(start)),
      .format = settings.format,
      .width = settings.width,
      .height = settings.height};
  stream_.send(settings, description, raw);
  ++frames_;
}

SimulatedCamera::SimulatedCamera(const SimulatedCameraConfig& config,
                                 std::function<void(const Exposure&, cv::Mat&)> draw)
    : impl_(std::make_unique<Impl>(config, std::move(draw))) {}

SimulatedCamera::~SimulatedCamera() = default;

void SimulatedCamera::pulse(int line) {
  constexpr std::array kLines{Trigger::kLine1, Trigger::kLine2, Trigger::kLine3, Trigger::kLine4};
  impl_->cue_.trigger(kLines.at(static_cast<std::size_t>(line - 1)));
}

void SimulatedCamera::power_cycle() { impl_->device_.power_cycle(); }

void SimulatedCamera::set_size(int width_px, int height_px) {
  impl_->device_.set_size(width_px, height_px);
}

void SimulatedCamera::set_faults(const CameraFaults& faults) {
  impl_->gone_ = faults.gone;
  impl_->stream_.set_loss(faults.gone ? 1.0 : faults.packet_loss, !faults.no_resend);
  impl_->device_.set_faults(!faults.no_resend, faults.pixel_format);
}

std::uint64_t SimulatedCamera::skipped() const { return impl_->skipped_; }

}  // namespace ols::sim
