// Computes the mid-exposure time of an RTSP camera's picture on the station's monotonic clock.
// Pure.
//
// There are two sources. Sender reports (RTCP) give the UTC of a picture's stamp, by the camera's
// own clock. But the first report may come after ten seconds or never, and the camera's clock may
// be wrong: set to local time, never set, drifting. The arrivals of the pictures are always
// available, but they are late by a delay that is only roughly known. The reports are used as long
// as the delay that they imply is credible. This delay is learnt. If the reports cease, the learnt
// delay is subtracted from the arrivals, and the times hardly change.
#pragma once

#include <cstdint>
#include <optional>

#include "edge/camera/frame_clock.h"
#include "edge/camera/rtsp/arrival_line.h"

namespace ols::camera {

struct RtspStamp {
  std::int64_t device_ns = 0;  // the RTP stamp, extended beyond 32 bits
  double arrival_s = 0.0;      // CLOCK_MONOTONIC of the picture's first packet
  // UTC of device_ns according to the newest sender report; nullopt before the first report.
  std::optional<std::int64_t> report_utc_ns;
};

class RtspClock {
 public:
  struct Config {
    double delay_s = 0.3;  // from mid-exposure to the arrival of the first packet
    double delay_sd_s = 0.3;
    double report_delay_s = 0.0;  // from mid-exposure to the instant whose UTC the camera reports
    double report_sd_s = 0.02;    // 1-sigma of that instant and of the camera's UTC together
  };
  explicit RtspClock(const Config& config) : config_(config) {}

  // The mid-exposure time of a picture. `utc_minus_monotonic_ns`: the current difference of the
  // station's two clocks.
  FrameTime stamp(const RtspStamp& picture, std::int64_t utc_minus_monotonic_ns);

  // Notes that the stream was restarted, with new RTP stamps. The learnt delay is kept.
  void restart();

  // The last stamp()'s result minus the time that the previous source would have given. Set only if
  // this stamp() changed the source.
  std::optional<double> jump_s() const { return jump_s_; }
  struct Delay {
    double delay_s, sd_s;  // from mid-exposure to the arrival of the first packet
  };
  // The delay learnt from the reports; nullopt if none was learnt. sd_s combines report_sd_s and
  // the scatter of the arrivals when it was learnt.
  std::optional<Delay> learnt_delay() const;
  // The learnt delay, or the configured one.
  Delay delay() const;
  // The delay that the sender report implies, if it is not credible; otherwise nullopt.
  std::optional<double> refused_delay_s() const { return refused_delay_s_; }
  // Seconds of the station's clock per second of the camera's stamps; nullopt until it is measured.
  std::optional<double> rate() const;

 private:
  // 1-sigma of the learnt delay from the scatter of the arrivals that it was learnt from. Call it
  // only if a delay was learnt.
  double learnt_scatter_s() const;
  void note_report(std::int64_t report_ns, std::int64_t offset_ns, double arrival_s);
  bool credible(double delay_s, double sd_s, double arrival_s) const;
  // sd_s of `delay`: the scatter of the arrivals alone.
  void learn(const Delay& delay, double arrival_s);
  MappedTime by_arrivals(const MappedTime& arrival) const;

  Config config_;
  ArrivalLine arrivals_;
  std::optional<std::int64_t> report_ns_;  // UTC of the newest report
  std::int64_t report_offset_ns_ = 0;
  // Arrival of the first picture after the reports' times were last stepped.
  std::optional<double> stepped_s_;
  // Smoothed mean square of the changes of (reported time - stamp) from report to report.
  double step_square_s2_ = 0.0;
  double learnt_delay_s_ = 0.0;
  double learnt_weight_ = 0.0;  // [1/s^2] sum, each the inverse square of the arrivals' scatter
  double learnt_s_ = 0.0;       // arrival at which the delay was last learnt
  int learnt_from_ = 0;         // number of samples in learnt_delay_s_
  std::optional<double> refused_since_s_, refused_delay_s_;
  std::optional<StampSource> source_;
  std::optional<double> jump_s_;
};

}  // namespace ols::camera
