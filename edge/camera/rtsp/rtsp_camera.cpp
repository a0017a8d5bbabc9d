#include "edge/camera/rtsp/rtsp_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "conditions/printed.h"
#include "edge/camera/picture.h"
#include "edge/camera/picture_change.h"
#include "edge/camera/retry_pause.h"
#include "edge/camera/rtsp/rtsp_stream.h"
#include "edge/device/password_file.h"

namespace ols::camera {
namespace {

constexpr double kPoll_s = 0.1;         // delay until the end is noticed
constexpr double kLongestTurn_s = 0.2;  // maximum that one turn adds to the silence

constexpr double kStampRateOff = 2e-3;  // no oscillator is so bad

std::string milliseconds(const char* format, double seconds) {
  return printed(format, 1e3 * seconds);
}

class RtspSource : public CameraSource {
 public:
  RtspSource(const RtspConfig& config, CameraHandover& handover)
      : config_(config), handover_(handover), clock_(config.clock) {}

  void serve() override;
  double pause_s() override {
    return pause_.after_stream(last_s_.value_or(0.0) - first_s_.value_or(0.0));
  }

 private:
  void connect(const std::string& password);
  void stream(RtspStream& stream);
  void take(RtspStream& stream, DecodedPicture picture);
  void note_time(const RtspStream& stream, const FrameTime& time, double now_s);
  std::vector<Alarm> alarms(double now_s) const;

  const RtspConfig config_;
  CameraHandover& handover_;
  RtspClock clock_;
  RetryPause pause_;
  PictureChange change_;      // over connections: a frozen camera sends the same picture again
  std::uint64_t number_ = 0;  // of the last frame
  std::uint64_t lost_packets_ = 0, switches_ = 0;

  // Of one connection.
  FrameStatistics statistics_;
  std::uint64_t first_number_ = 0;
  std::optional<double> first_s_, last_s_;  // arrivals of good frames
  std::uint64_t lost_here_ = 0;
};

void RtspSource::serve() {
  const std::string password = device::read_password(config_.password_file);
  try {
    connect(password);
  } catch (const LoginRefused& error) {
    handover_.note_failure(CameraState::kFault, error.alarm);
    device::wait_for_other_password(config_.password_file, password, [this](double pause_s) {
      handover_.wait(pause_s);
      return !handover_.ended();
    });
  }
}

void RtspSource::connect(const std::string& password) {
  statistics_ = {};
  first_number_ = number_;
  first_s_.reset();
  last_s_.reset();
  clock_.restart();
  RtspStream connection(config_, password);
  stream(connection);
}

void RtspSource::stream(RtspStream& stream) {
  const double period_s = 1.0 / config_.frame_rate_hz;
  double silence_s = 0.0, turned_s = clock_monotonic_s();
  lost_here_ = 0;
  while (!handover_.ended()) {
    auto picture = stream.receive(kPoll_s);
    const double now_s = clock_monotonic_s();
    // A longer turn was a pause of this process, not of the camera.
    silence_s = picture ? 0.0 : silence_s + std::min(now_s - turned_s, kLongestTurn_s);
    turned_s = now_s;
    if (picture) take(stream, std::move(*picture));
    const double patience_s = first_s_ ? config_.no_frame_timeout_s : config_.first_frame_timeout_s;
    if (silence_s > patience_s + 2.0 * period_s) throw CameraAbsent(alarm::camera_lost());
  }
}

void RtspSource::take(RtspStream& stream, DecodedPicture picture) {
  const std::uint64_t number = first_number_ + picture.rtp.number;
  const std::uint64_t lost = number > number_ + 1 && first_s_ ? number - number_ - 1 : 0;
  number_ = std::max(number_, number);
  statistics_.add(picture.rtp.arrival_s, !picture.rtp.broken);
  lost_packets_ += stream.lost_packets() - std::exchange(lost_here_, stream.lost_packets());
  if (picture.rtp.broken) return handover_.note_incomplete(lost, statistics_);
  const double now_s = picture.rtp.arrival_s;
  if (!first_s_) {
    first_s_ = now_s;
    handover_.note_opened("RTSP " + stream.codec());
  }
  last_s_ = now_s;
  if (picture.gray.cols != config_.width_px || picture.gray.rows != config_.height_px)
    return handover_.note_refused(PictureRefusal::kWrongSize, lost, statistics_);
  const double unchanged_s = change_.unchanged_s(picture.gray, now_s);
  if (config_.frozen_s > 0.0 && unchanged_s >= config_.frozen_s)
    throw CameraAbsent(alarm::camera_frozen(unchanged_s));
  const FrameTime time = clock_.stamp({.device_ns = picture.rtp.device_ns,
                                       .arrival_s = picture.rtp.arrival_s,
                                       .report_utc_ns = picture.rtp.report_utc_ns},
                                      clock_utc_ns() - clock_monotonic_ns());
  note_time(stream, time, now_s);
  Frame frame{.gray = std::move(picture.gray),
              .mid_exposure_s = time.mid_exposure_s,
              .stamp_sd_s = time.sd_s,
              .stamp_source = time.source,
              .row_readout_s = config_.row_readout_s,
              .number = number,
              .raw = std::move(picture.bgr),
              .pixel_format = config_.pixel_format};
  handover_.publish(std::move(frame), lost, statistics_);
}

std::vector<Alarm> RtspSource::alarms(double now_s) const {
  std::vector<Alarm> alarms;
  if (auto differs = rate_alarm(config_, statistics_.rate_hz(), now_s - first_s_.value_or(now_s)))
    alarms.push_back(std::move(*differs));
  const double rate = clock_.rate().value_or(1.0);
  if (std::abs(rate - 1.0) > kStampRateOff)
    alarms.push_back(alarm::camera_stamps_run_wrong(100.0 * (1.0 / rate - 1.0)));
  if (const auto delay_s = clock_.refused_delay_s())
    alarms.push_back(alarm::camera_reports_refused(*delay_s));
  return alarms;
}

void RtspSource::note_time(const RtspStream& stream, const FrameTime& time, double now_s) {
  const bool by_reports = time.source == StampSource::kCamera;
  std::string switched;
  if (const auto jump_s = clock_.jump_s()) {
    ++switches_;
    switched = std::string("camera: its times are now by ") +
               (by_reports ? "sender reports: " : "arrivals: ") + milliseconds("%+.0f ms", *jump_s);
  }
  const RtspClock::Delay delay = clock_.delay();
  handover_.change_facts([&](CameraFacts& facts) {
    facts.identity = "RTSP " + stream.codec() +
                     (by_reports ? ", times by sender reports" : ", times by arrivals") +
                     milliseconds(", delay %.0f ms", delay.delay_s);
    facts.kind_alarms = alarms(now_s);
    facts.kind_readings = {{"camera_delay_s", delay.delay_s}, {"camera_delay_sd_s", delay.sd_s}};
    facts.kind_counters = {{"camera_packets_lost", lost_packets_},
                           {"camera_time_switches", switches_}};
    if (switched.empty()) return;
    facts.last_error = switched;
    ++facts.errors;
  });
}

}  // namespace

RtspCamera::RtspCamera(const RtspConfig& config)
    : ThreadedCamera(config, [&config](CameraHandover& handover) {
        return std::make_unique<RtspSource>(config, handover);
      }) {}

}  // namespace ols::camera
