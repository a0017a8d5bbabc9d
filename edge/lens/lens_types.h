// Orders to a motorised lens, and the lens's reports. Positions are shares of the travel, from 0 to
// 1: zoom from widest to longest, focus from far to near, iris from closed to open. Rates are
// relative to the motor's maximum speed, from -1 to 1. Pure.
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

// An order to one axis: a position to reach or, if there is none, a rate until `until_s` (monotonic
// time).
struct AxisOrder {
  std::optional<double> position;
  double rate = 0.0;
  double until_s = 0.0;
};

// Orders to some of the axes. The other axes continue as before.
struct LensOrder {
  ByAxis<std::optional<AxisOrder>> axes;
};

// A zoom position that the lens has reported.
struct ZoomSample {
  double time_s = 0.0;     // monotonic time: middle between question and answer
  double time_sd_s = 0.0;  // 1-sigma
  double position = 0.0;
};

// Counters that only increase.
struct LensCounters {
  std::uint64_t requests = 0, replies = 0;
  std::uint64_t timeouts = 0;  // requests that the lens did not answer in time
  std::uint64_t refusals = 0;  // answers that are errors
  std::uint64_t garbled = 0;   // packets of unknown form, and values of wrong form
};

struct LensState {
  bool ready = false;  // the lens has reported its version and its zoom position
  ByAxis<std::optional<double>> positions;
  std::string version;
  std::string last_error;
  std::optional<double> last_good_s;
};

}  // namespace ols::lens
