// Converts times of the camera's clock to the station's CLOCK_MONOTONIC, by a fitted line with its
// uncertainty. Pure.
//
// There are two sources of data. A *latch* reads the camera's clock between two readings of the
// station's clock. The camera's reading therefore lies between these two, whatever the network
// delay is. The *arrival* of a frame gives only a bound: no frame arrives earlier than its stamp
// plus a roughly known delay. The least delayed of many arrivals gives the tightest bound.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace ols::camera {

struct LatchSample {
  std::int64_t device_ns = 0;  // the camera's clock
  double before_s = 0.0;       // the station's clock before the latch was requested
  double after_s = 0.0;        // the station's clock after the answer
};

struct MappedTime {
  double time_s = 0.0;  // the station's monotonic clock
  double sd_s = 0.0;    // 1-sigma
};

class ClockMap {
 public:
  struct Config {
    int window = 64;                 // number of latches kept
    double rate_sd = 1e-4;           // 1-sigma of the rate error of the camera's oscillator
    double rate_wander = 1e-6;       // 1-sigma of the change of the rate over the window
    double device_sd_s = 20e-6;      // 1-sigma of the camera's own error in a single stamp or latch
    double arrival_window_s = 10.0;  // how long arrivals are kept
  };
  explicit ClockMap(const Config& config) : config_(config) {}

  // Adds a latch. Returns false if it is invalid: after_s earlier than before_s, or a value not
  // finite. A latch far from the line is held back. If the next latch agrees with the one held
  // back, the camera's clock has been stepped, and the fit restarts from these two.
  bool add_latch(const LatchSample& sample);
  void add_arrival(std::int64_t device_ns, double arrival_s);
  void clear();

  // The station's time for a stamp of the camera, according to the latches; nullopt without
  // latches.
  std::optional<MappedTime> from_latches(std::int64_t device_ns) const;

  // The same according to the arrivals: the earliest possible arrival of a frame with this stamp,
  // minus `delay_s`. The result's sd_s does not include the error of `delay_s`. nullopt without
  // arrivals.
  std::optional<MappedTime> from_arrivals(std::int64_t device_ns, double delay_s) const;

  int latches() const { return static_cast<int>(latches_.size()); }
  // Relative rate error of the camera's clock; > 0 if the clock is slow.
  double rate_error() const { return fit_.rate; }

 private:
  // Station's time = origin + t + offset + rate * t; t is the camera's time since the newest latch.
  struct Fit {
    double offset = 0.0, rate = 0.0;
    double var_offset = 0.0, var_rate = 0.0, covariance = 0.0;
    double systematic_sd_s = 0.0;
  };
  double seconds(std::int64_t device_ns) const;  // time since the newest latch
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
  int arrivals_off_ = 0;  // number of consecutive arrivals much later than expected
};

}  // namespace ols::camera
