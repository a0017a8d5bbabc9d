// Fits a line that predicts the arrival of a picture from the camera's stamp of it. Pure.
//
// The network, the encoder and a busy host can only delay a picture. Therefore, only the least
// delayed picture of every two seconds is used. The line's slope is the rate of the camera's
// stamps, even if these run far too fast or too slowly.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "edge/camera/clock_map.h"

namespace ols::camera {

class ArrivalLine {
 public:
  // `device_ns`: the camera's stamp; `arrival_s`: CLOCK_MONOTONIC at the picture's arrival.
  void add(std::int64_t device_ns, double arrival_s);
  void clear() { *this = ArrivalLine(); }

  // The arrival time to expect for a picture with this stamp, if its delay is the usual minimum.
  // sd_s is the scatter of the least delayed pictures about the line. nullopt before the first
  // add().
  std::optional<MappedTime> at(std::int64_t device_ns) const;
  // Seconds of the station's clock per second of the camera's stamps. In the first seconds, a rate
  // of about 1 is assumed unless the arrivals clearly show another one.
  double rate() const { return rate_; }
  // Whether rate() has been measured over four spans of two seconds that have ended.
  bool knows_rate() const;
  // Whether there are enough of these spans to tell stamps that run 0.5 % wrong from late pictures.
  bool shows_scatter() const;

 private:
  struct Least {
    double device_s, arrival_s;
  };
  double seconds(std::int64_t device_ns) const;
  double residual_s(const Least& least) const;
  double step_limit_s() const;
  void forget_what_came_before_a_step();
  void fit();
  struct Fitted {
    double offset_s, rate, sd_s;
  };
  // The line through the first `used` spans. `free`: the rate is not bounded.
  Fitted fitted_from(double start_rate, bool free, std::size_t used) const;

  std::int64_t origin_ns_ = 0;
  double span_from_s_ = 0.0;  // arrival at the start of the newest span
  // The least delayed picture of each span; the newest span is still open.
  std::deque<Least> least_;
  double reference_s_ = 0.0;  // stamp of the newest picture at the last fit
  double offset_s_ = 0.0;     // arrival at reference_s_
  double rate_ = 1.0;
  double sd_s_ = 0.0;
};

}  // namespace ols::camera
