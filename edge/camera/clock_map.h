// The camera's clock against the station's CLOCK_MONOTONIC: a fitted line with its uncertainty.
// Pure.
//
// Two sources. A *latch* reads the camera's clock between two readings of the station's: the truth
// lies in between, whatever the network did. A frame's *arrival* only bounds it: it came no earlier
// than its stamp plus a delay that is known roughly; the earliest of many is the closest.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace ols::camera {

struct LatchSample {
  std::int64_t device_ns = 0;  // the camera's clock
  double before_s = 0.0;       // the station's, before the latch was asked for
  double after_s = 0.0;        // and after it was answered
};

struct MappedTime {
  double time_s = 0.0;  // the station's monotonic clock
  double sd_s = 0.0;    // 1-sigma
};

class ClockMap {
 public:
  struct Config {
    int window = 64;                 // latches kept
    double rate_sd = 1e-4;           // how far off a camera's oscillator may be (1-sigma)
    double rate_wander = 1e-6;       // by how much the rate may have changed over the window
    double device_sd_s = 20e-6;      // of a single stamp or latch inside the camera
    double arrival_window_s = 10.0;  // arrivals kept
  };
  explicit ClockMap(const Config& config) : config_(config) {}

  // False: refused, not an interval. A sample far off the line is set aside; when the next one
  // agrees with it, the camera's clock was stepped and the fit begins anew.
  bool add_latch(const LatchSample& sample);
  void add_arrival(std::int64_t device_ns, double arrival_s);
  void clear();

  // From the latches; nothing without any.
  std::optional<MappedTime> from_latches(std::int64_t device_ns) const;

  // From the arrivals: the instant `delay_s` before the earliest arrival that such a stamp could
  // have had; sd_s is that of the envelope, to which the delay's own adds. Nothing without any.
  std::optional<MappedTime> from_arrivals(std::int64_t device_ns, double delay_s) const;

  int latches() const { return static_cast<int>(latches_.size()); }
  double rate_error() const { return fit_.rate; }  // of the camera's clock: > 0 when it is slow

 private:
  struct Fit {  // monotonic = origin + t + offset + rate * t, t since the newest latch
    double offset = 0.0, rate = 0.0;
    double var_offset = 0.0, var_rate = 0.0, covariance = 0.0;
    double systematic_sd_s = 0.0;
  };
  double seconds(std::int64_t device_ns) const;  // since the newest latch
  bool far_off(const LatchSample& sample) const;
  void refit();

  Config config_;
  std::deque<LatchSample> latches_;
  std::optional<LatchSample> suspect_;
  Fit fit_;

  struct Arrival {
    std::int64_t device_ns;
    double arrival_s;
  };
  std::deque<Arrival> arrivals_;
  int arrivals_off_ = 0;  // in a row that do not fit the envelope at all
};

}  // namespace ols::camera
