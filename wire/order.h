// Operators' orders to a station and to the fusion, and the replies to them, as plain values.
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
  // kDesignate, kCentre, kLook: mid-exposure of the frame [us UTC]; 0 means the newest frame.
  // kDesignate has a box, the others a point, in pixels of the full-resolution frame. kLook
  // designates the object at the point, so that other stations search along that line of sight.
  std::int64_t frame_utime_us = 0;
  double x_px = 0.0, y_px = 0.0, width_px = 0.0, height_px = 0.0;
  // kPoint: pan and tilt as the PTU counts them.
  double pan_rad = 0.0, tilt_rad = 0.0;
  // kRate: rates of the PTU's angles, for the lease (lease_s()).
  double pan_rate_rad_s = 0.0, tilt_rate_rad_s = 0.0;
  // kLens: positions of the axes, or rates for the lease if lens_rates is true. NaN leaves an axis
  // as it is (lcmtypes/lens_command_t.lcm).
  bool lens_rates = false;
  double zoom = kNaN, focus = kNaN, iris = kNaN;
  // kRecord: how much to keep from before and after now, and the name of the recording.
  double before_s = 0.0, after_s = 0.0;
  std::string label = {};
};

// An operator's decision, for the fusion: whether stations may be slewed to a cue, to a target, or
// to everything that detectors find.
struct CueOrder {
  std::string cue;
  bool allow = false;
  OrderId id = {};
  // "off", "propose" or "automatic": the decision is about everything that detectors find. Empty:
  // the decision is about `cue`.
  std::string handover = {};
};

// A station's answer to an order, or the fusion's answer to an order on a cue.
struct Reply {
  std::string station = {};  // empty if the fusion answers
  OrderId order = {};
  bool is_accepted = false;
  std::string reason = {};  // why the order was refused: the name of a counter, such as "no_frame"
  std::string detail = {};  // details for a person
  bool is_stopped = false;  // whether the station is stopped after the order
};

// The lease of an order: a station obeys the order only within this time after it was made, and the
// sender waits for the answer for this time. A joystick's order has a shorter lease.
inline constexpr double kLease_s = 2.0;
// Two status intervals, and some reserve: every station sends at least one status within this time.
inline constexpr double kTwoIntervals_s = 1.2;
// Interval at which a rate is repeated while the joystick is held. If two repetitions in a row are
// lost, the third still arrives before the lease ends.
inline constexpr double kRateAgain_s = 0.1;
// The lease of a joystick's order, and the longest that a station accepts for it: kRateLease_s of
// geometry/slew_limits.h.
inline constexpr double kJoystickLease_s = 0.3;
// Interval at which a stop is repeated until the station confirms it, because a flooded network
// loses messages.
inline constexpr double kStopAgain_s = 0.02;

// Whether the order comes from a joystick: a rate of the PTU or of the lens. Such a rate holds only
// for its lease.
bool is_joystick(const Order& order);
double lease_s(const Order& order);

// The name of a kind, for example "reference_ok".
std::string_view name(Kind kind);
std::optional<Kind> kind_named(std::string_view name);

}  // namespace ols::wire
