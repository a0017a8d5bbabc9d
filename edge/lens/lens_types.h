// Orders to a motorised lens, and its reports. Positions are shares of the travel: zoom 0 widest ..
// 1 longest, focus 0 far .. 1 near, iris 0 closed .. 1 open. Rates are relative to the motor's
// maximum speed, -1..1. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ols::lens {

enum class Axis { kZoom, kFocus, kIris };
inline constexpr std::array kAxes{Axis::kZoom, Axis::kFocus, Axis::kIris};

// One value for each axis.
template <class T>
struct ByAxis {
  T zoom{}, focus{}, iris{};
  T& operator[](Axis axis) {
    return axis == Axis::kZoom ? zoom : axis == Axis::kFocus ? focus : iris;
  }
  const T& operator[](Axis axis) const {
    return axis == Axis::kZoom ? zoom : axis == Axis::kFocus ? focus : iris;
  }
};

// An order to an axis: a position to reach, or a rate until an instant of the monotonic clock.
struct AxisOrder {
  std::optional<double> position;
  double rate = 0.0;
  double until_s = 0.0;
};

// Orders to some axes; the other axes continue as before.
struct LensOrder {
  ByAxis<std::optional<AxisOrder>> axes;
};

// A zoom position, read at about this instant of the monotonic clock.
struct ZoomSample {
  double time_s = 0.0;     // middle of the time in which it was read
  double time_sd_s = 0.0;  // 1-sigma
  double position = 0.0;
};

// Counters, which only increase.
struct LensCounters {
  std::uint64_t requests = 0, replies = 0;
  std::uint64_t timeouts = 0;  // requests without an answer in time
  std::uint64_t refusals = 0;  // errors in the lens's answers
  std::uint64_t garbled = 0;   // bytes that are not part of a message
};

struct LensState {
  bool ready = false;  // the lens has reported its version and its zoom position
  ByAxis<std::optional<double>> positions;
  std::string version;
  std::string last_error;
  std::optional<double> last_good_s;
};

}  // namespace ols::lens
