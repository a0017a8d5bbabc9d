// Reads the output of aircraft receivers: Beast's binary frames, SBS's lines, readsb's
// aircraft.json.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/adsb.h"

namespace ols::calibration {

// Beast, port 30005: Mode S frames with a 12 MHz counter, from a stream in any pieces.
class BeastFrames {
 public:
  struct Frame {
    std::uint64_t ticks = 0;  // count of the 12 MHz clock
    std::vector<std::uint8_t> message;
  };
  // Takes bytes, and returns the long frames that they complete.
  std::vector<Frame> take(std::span<const std::uint8_t> bytes);

 private:
  std::vector<std::uint8_t> frame_;  // bytes after the escape that begins a frame, with escapes
                                     // removed
  bool is_inside_ = false, is_escaped_ = false;
};

// Converts a receiver's counter to this host's time. The counter has no time of day, and each frame
// arrives with a delay. The time of the first frame follows from the frame with the least delay.
class TickClock {
 public:
  // [us] Time from the first frame to this one, which arrived at `arrival_utime_us`.
  std::int64_t take(std::uint64_t ticks, std::int64_t arrival_utime_us);
  // The time of the first frame, from all frames so far.
  std::int64_t first_utime_us() const { return first_utime_us_; }

 private:
  std::optional<std::uint64_t> first_ticks_;
  std::int64_t first_utime_us_ = 0;
};

// The delay of messages, by the receiver's own stamps. No message arrives before it was sent, and
// of many messages one is hardly delayed. So the least delay is the offset between the clocks.
class ReceiverDelay {
 public:
  void note(std::int64_t stamp_utime_us, std::int64_t arrival_utime_us);
  // [us] Least delay so far; nullopt: no message was stamped.
  std::optional<std::int64_t> least_us() const { return least_us_; }

 private:
  std::optional<std::int64_t> least_us_;
};

// Reads a line of SBS, port 30003; nullopt if it has no position. Its height is barometric, and
// usable only if the receiver is configured to write geometric heights. Its times have no time zone
// and are taken as UTC.
std::optional<AircraftPosition> sbs_position(const std::string& line);

struct AircraftSnapshot {
  std::int64_t utime_us = 0;  // `now`, by the receiver's clock
  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
};
// aircraft.json of readsb and dump1090: `now` minus `seen_pos`, and `alt_geom`. Throws
// std::runtime_error for any other text.
AircraftSnapshot aircraft_json(const std::string& text);

}  // namespace ols::calibration
