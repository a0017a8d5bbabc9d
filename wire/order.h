// An operator's command to one station, as plain values.
#pragma once

#include <compare>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace ols::wire {

enum class Kind {
  kDesignate,
  kPoint,
  kStop,
  kRelease,
  kRearm,
  kHome,
  kReferenceOk,
  kRecord,
  kRate,
  kLens,
  kCentre,
  kLook
};

// Identifies an order: a random number drawn at the sender's start, and a count of the sender's
// orders since then.
struct OrderId {
  std::int64_t boot_id = 0, sequence = 0;
  auto operator<=>(const OrderId&) const = default;
};

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct Order {
  std::string station = {};
  Kind kind = Kind::kStop;
  OrderId id = {};
  // kDesignate, kCentre, kLook: mid-exposure of the frame [us UTC]; 0 means the newest frame. The
  // box (kCentre, kLook: only the point) is in pixels of the full-resolution frame. kLook
  // designates the object at the point.
  std::int64_t frame_utime_us = 0;
  double x_px = 0.0, y_px = 0.0, width_px = 0.0, height_px = 0.0;
  // kPoint: the angles as the PTU counts them.
  double pan_rad = 0.0, tilt_rad = 0.0;
  // kRate: rates of the PTU's angles. They hold for the lease.
  double pan_rate_rad_s = 0.0, tilt_rate_rad_s = 0.0;
  // kLens: positions, or rates that hold for the lease. NaN leaves the axis as it is
  // (lens_command_t).
  bool lens_rates = false;
  double zoom = kNaN, focus = kNaN, iris = kNaN;
  // kRecord: the time to keep before and after the present.
  double before_s = 0.0, after_s = 0.0;
  std::string label = {};
};

// An operator's decision for the fusion: on a cue, on a target, or on everything that detectors
// find.
struct CueOrder {
  std::string cue;
  bool allow = false;
  OrderId id = {};
  // "off", "propose" or "automatic": a decision on everything that detectors find. If empty, the
  // decision is on `cue`.
  std::string handover = {};
};

// A station's answer to an order, or the fusion's answer to an order on a cue.
struct Reply {
  std::string station = {};  // empty if the fusion answers
  OrderId order = {};
  bool is_accepted = false;
  std::string reason = {};  // why it was refused: the name of a counter, such as "no_frame"
  std::string detail = {};  // details for a person
  bool is_stopped = false;  // whether the station is stopped after the order
};

// How long a station obeys an order after its creation, and therefore how long the sender waits for
// the answer.
inline constexpr double kLease_s = 2.0;
// Two status intervals: every station sends a status within this time.
inline constexpr double kTwoIntervals_s = 1.2;
// Interval at which a rate is repeated while the joystick is held. Two repetitions in a row may get
// lost before the lease ends.
inline constexpr double kRateAgain_s = 0.1;
// The longest lease that a station accepts: kRateLease_s of geometry/slew_limits.h.
inline constexpr double kJoystickLease_s = 0.3;
// Interval at which a stop is repeated until its station confirms it, because a flooded network
// loses some messages.
inline constexpr double kStopAgain_s = 0.02;

// Whether the order comes from a joystick; such an order moves the unit or the lens for a lease.
bool is_joystick(const Order& order);
double lease_s(const Order& order);

// For example "reference_ok".
std::string_view name(Kind kind);
std::optional<Kind> kind_named(std::string_view name);

}  // namespace ols::wire
