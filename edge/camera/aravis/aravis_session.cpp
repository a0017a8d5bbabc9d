#include "edge/camera/aravis/aravis_session.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "edge/camera/tai_reference.h"

namespace ols::camera {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr int kFirstLatches = 10;     // in a row at the start, so that the first frame has its time
constexpr double kLookEvery_s = 1.0;  // between later checks of the camera's clock
constexpr int kTemperatureEvery = 10;     // checks
constexpr double kPoll_s = 0.1;           // delay until a lost control or the end is noticed
constexpr double kTriggerPoll_s = 0.002;  // delay of a software trigger
constexpr double kLongestTurn_s = 0.2;    // maximum that one turn adds to the silence

FrameClock::Config clock_config(const AravisConfig& config) {
  return {.stamp_at = config.stamp_at,
          .readout_s = config.readout_s,
          .readout_sd_s = config.readout_sd_s,
          .map = {}};
}

}  // namespace

AravisSession::AravisSession(const AravisConfig& config, AravisDevice& device,
                             FrameNumbers& numbers, CameraHandover& handover)
    : config_(config),
      expected_{.width_px = config.width_px,
                .height_px = config.height_px,
                .format = *pixel_format(config.pixel_format)},
      device_(device),
      numbers_(numbers),
      handover_(handover),
      clock_(clock_config(config)),
      exposures_(1e-6 * device.exposure().exposure_us, 1.0 / config.frame_rate_hz) {
  if (config.auto_exposure)
    automatic_.emplace(config.auto_levels, device.limits(), device.exposure());
  numbers.restart();
  handover.change_facts([&](CameraFacts& facts) {
    facts.exposure = device.exposure();
    facts.missing_light = 1.0;
  });
  handover.note_opened(device.identity(), device.serial());
  for (int i = 1; i < kFirstLatches; ++i)
    if (const auto sample = device.latch()) clock_.map().add_latch(*sample);
  look();
}

void AravisSession::stream() {
  const double poll_s = config_.trigger == TriggerMode::kSoftware ? kTriggerPoll_s : kPoll_s;
  auto last_turn = Clock::now();
  while (!handover_.ended()) {
    const bool received = device_.receive(poll_s, [&](const ReceivedFrame& f) { take(f); });
    const auto now = Clock::now();
    watch(received, Seconds(now - last_turn).count());
    last_turn = now;
    if (handover_.take_trigger() && config_.trigger == TriggerMode::kSoftware) device_.trigger();
    if (next_exposure_) change_exposure();
    // Right after a frame there is time until the next one.
    const bool time = received || !is_timed(config_.trigger);
    if (time && clock_monotonic_s() - looked_s_ >= kLookEvery_s) look();
  }
  if (is_timed(config_.trigger) && silence_s_ > kLongestTurn_s + 2.0 / config_.frame_rate_hz)
    device_.give_up();  // the disconnection from a silent camera would take seconds
}

// Throws CameraAbsent when the camera is gone.
void AravisSession::watch(bool received, double turn_s) {
  // A longer turn was a pause of this process, not of the camera.
  silence_s_ = received ? 0.0 : silence_s_ + std::min(turn_s, kLongestTurn_s);
  const bool silent = silence_s_ > config_.no_frame_timeout_s + 2.0 / config_.frame_rate_hz;
  if (silent && !is_timed(config_.trigger) && device_.answers()) {
    silence_s_ = 0.0;  // there was no trigger
  } else if (silent || device_.control_lost()) {
    device_.give_up();
    throw CameraAbsent(silent ? alarm::camera_lost() : alarm::camera_lost_answer());
  }
}

// Checks what changes slowly: the camera's clock, PTP, temperature.
void AravisSession::look() {
  looked_s_ = clock_monotonic_s();
  if (const auto sample = device_.latch()) clock_.map().add_latch(*sample);
  std::optional<PtpState> ptp;
  if (config_.ptp != "off") {
    ptp = device_.ptp().value_or(PtpState::kUnknown);
    clock_.set_tai(ptp == PtpState::kSlave
                       ? read_tai_reference(config_.tai_minus_utc_s, config_.ptp_sd_s)
                       : std::nullopt);
  }
  const bool warm = looks_++ % kTemperatureEvery == 0;
  const auto temperature_degC = warm ? device_.temperature_degC() : std::nullopt;
  handover_.change_facts([&](CameraFacts& facts) {
    facts.ptp = ptp;
    facts.ptp_disagreement_s = clock_.tai_disagreement_s();
    if (warm) facts.temperature_degC = temperature_degC;
  });
}

void AravisSession::take(const ReceivedFrame& received) {
  const FrameNumbers::Step step = numbers_.next(received.id);
  statistics_.add(received.complete ? received.arrival_s : clock_monotonic_s(), received.complete);
  if (!received.complete) return handover_.note_incomplete(step.lost, statistics_);
  const PictureRefusal refusal = check(received.picture, expected_);
  if (refusal != PictureRefusal::kNone)
    return handover_.note_refused(refusal, step.lost, statistics_);
  const FrameTime time = clock_.stamp(received.device_ns, received.arrival_s, exposures_);
  Frame frame{.gray = {},
              .mid_exposure_s = time.mid_exposure_s,
              .stamp_sd_s = time.sd_s,
              .stamp_source = time.source,
              .number = step.number,
              .raw = {},
              .pixel_format = pixel_format_name(received.picture.format)};
  // After a pause only the newest frame is used, not those that have piled up.
  if (!received.overtaken) {
    frame.gray = to_gray(received.picture);
    if (config_.keep_raw) frame.raw = raw_beside_gray(received.picture);
  }
  if (automatic_ && !received.overtaken) choose_exposure(frame.gray);
  handover_.publish(std::move(frame), step.lost, statistics_);
}

void AravisSession::choose_exposure(const cv::Mat& gray) {
  if (const auto next = automatic_->step(measure_levels(gray, handover_.region())))
    next_exposure_ = next;
}

void AravisSession::change_exposure() {
  const double asked_s = clock_monotonic_s();
  device_.set_exposure(*std::exchange(next_exposure_, std::nullopt));
  exposures_.change(asked_s, clock_monotonic_s(), 1e-6 * device_.exposure().exposure_us);
  automatic_->applied(device_.exposure());
  handover_.change_facts([&](CameraFacts& facts) {
    facts.exposure = device_.exposure();
    facts.missing_light = automatic_->missing_factor();
  });
}

}  // namespace ols::camera
