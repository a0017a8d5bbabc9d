#include "edge/camera/rtsp/rtsp_clock.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ols::camera {
namespace {

constexpr double kSigmas = 5.0;
constexpr std::int64_t kNewReport_ns = 50'000;  // rounding of the stamps alone makes less
constexpr double kStep_s = 0.1;                 // between two reports: the clock was set
constexpr double kSteady_s = 12.0;              // after that it counts again: two reports
constexpr double kLyingRate = 5e-3;             // no oscillator is so bad
constexpr double kSmoothing = 0.2;
constexpr double kLearnEvery_s = 5.0;
constexpr int kLearnt = 6;  // times; the first reports may be of another clock than the camera's
constexpr int kLearnFrom = 720;      // times, an hour: a slow drift shows against their mean
constexpr double kForget_s = 600.0;  // reports refused for so long may have become right

}  // namespace

void RtspClock::restart() {
  arrivals_.clear();
  report_ns_.reset();
  stepped_s_.reset();
  step_square_s2_ = 0.0;
  refused_since_s_.reset();
}

std::optional<RtspClock::Delay> RtspClock::learnt_delay() const {
  if (learnt_from_ == 0) return std::nullopt;
  return Delay{learnt_delay_s_, std::hypot(learnt_scatter_s(), config_.report_sd_s)};
}

RtspClock::Delay RtspClock::delay() const {
  return learnt_delay().value_or(Delay{config_.delay_s, config_.delay_sd_s});
}

double RtspClock::learnt_scatter_s() const { return std::sqrt(learnt_from_ / learnt_weight_); }

std::optional<double> RtspClock::rate() const {
  return arrivals_.knows_rate() ? std::optional(arrivals_.rate()) : std::nullopt;
}

// `report_ns`: UTC minus stamp by the camera; `offset_ns`: the station's monotonic time minus
// stamp.
void RtspClock::note_report(std::int64_t report_ns, std::int64_t offset_ns, double arrival_s) {
  const bool is_first = !report_ns_;
  if (!is_first && std::abs(report_ns - *report_ns_) <= kNewReport_ns) return;
  if (!is_first) {
    const double step_s = 1e-9 * static_cast<double>(offset_ns - report_offset_ns_);
    if (std::abs(step_s) > kStep_s)
      stepped_s_ = arrival_s;
    else
      step_square_s2_ += kSmoothing * (step_s * step_s - step_square_s2_);
  }
  report_ns_ = report_ns;
  report_offset_ns_ = offset_ns;
}

// Not before the exposure, not later than the configured delay allows, and as ever; by a clock that
// was not set just now, and with stamps that run as time does.
bool RtspClock::credible(double delay_s, double sd_s, double arrival_s) const {
  if (stepped_s_ && arrival_s - *stepped_s_ < kSteady_s) return false;
  if (std::abs(rate().value_or(1.0) - 1.0) > kLyingRate) return false;
  const double slack_s = kSigmas * sd_s;
  if (delay_s < -slack_s) return false;
  if (delay_s > config_.delay_s + kSigmas * config_.delay_sd_s + slack_s) return false;
  return learnt_from_ < kLearnt ||
         std::abs(delay_s - learnt_delay_s_) < kSigmas * std::hypot(sd_s, learnt_scatter_s());
}

// While host and network are busy, even the least delayed pictures are late, by about as much as
// they scatter. A delay that is learnt then is too long by that: it counts the less, the more they
// scatter, and is no surer than the arrivals that it is learnt from. Stamps that run wrong give a
// wrong delay: nothing is learnt before they would show.
void RtspClock::learn(const Delay& delay, double arrival_s) {
  if (learnt_from_ > 0 && arrival_s - learnt_s_ < kLearnEvery_s) return;
  learnt_s_ = arrival_s;
  if (learnt_from_ < kLearnt && std::abs(delay.delay_s - learnt_delay_s_) > kStep_s)
    learnt_from_ = 0;
  if (learnt_from_ == 0) learnt_weight_ = 0.0;
  if (learnt_from_ == kLearnFrom)
    learnt_weight_ *= 1.0 - 1.0 / kLearnFrom;
  else
    ++learnt_from_;
  const double weight = 1.0 / (delay.sd_s * delay.sd_s);
  learnt_weight_ += weight;
  learnt_delay_s_ += (delay.delay_s - learnt_delay_s_) * weight / learnt_weight_;
}

MappedTime RtspClock::by_arrivals(const MappedTime& arrival) const {
  const auto [delay_s, sd_s] = delay();
  return {.time_s = arrival.time_s - delay_s, .sd_s = std::hypot(arrival.sd_s, sd_s)};
}

FrameTime RtspClock::stamp(const RtspStamp& picture, std::int64_t utc_minus_monotonic_ns) {
  arrivals_.add(picture.device_ns, picture.arrival_s);
  const MappedTime arrival = *arrivals_.at(picture.device_ns);
  MappedTime time = by_arrivals(arrival);
  StampSource source = StampSource::kArrival;
  MappedTime other = time;
  refused_delay_s_.reset();
  if (!picture.report_utc_ns) refused_since_s_.reset();
  if (picture.report_utc_ns) {
    const std::int64_t monotonic_ns = *picture.report_utc_ns - utc_minus_monotonic_ns;
    note_report(*picture.report_utc_ns - picture.device_ns, monotonic_ns - picture.device_ns,
                picture.arrival_s);
    const MappedTime reported{
        .time_s = 1e-9 * static_cast<double>(monotonic_ns) - config_.report_delay_s,
        .sd_s = std::hypot(config_.report_sd_s, std::sqrt(step_square_s2_))};
    const double delay_s = arrival.time_s - reported.time_s;
    if (credible(delay_s, std::hypot(reported.sd_s, arrival.sd_s), picture.arrival_s)) {
      if (arrivals_.shows_scatter()) learn({delay_s, arrival.sd_s}, picture.arrival_s);
      time = reported;
      source = StampSource::kCamera;
      refused_since_s_.reset();
    } else {
      other = reported;
      refused_delay_s_ = delay_s;
      if (!refused_since_s_) refused_since_s_ = picture.arrival_s;
      if (picture.arrival_s - *refused_since_s_ > kForget_s) {
        learnt_from_ = 0;
        refused_since_s_ = picture.arrival_s;
      }
    }
  }
  jump_s_.reset();
  if (source_ && *source_ != source) jump_s_ = time.time_s - other.time_s;
  source_ = source;
  return {.mid_exposure_s = time.time_s, .sd_s = time.sd_s, .source = source};
}

}  // namespace ols::camera
