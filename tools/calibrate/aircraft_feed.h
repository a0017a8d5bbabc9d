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

// Beast, port 30005: reads Mode S frames with the count of a 12 MHz clock, from a stream that
// arrives in any pieces.
class BeastFrames {
 public:
  struct Frame {
    std::uint64_t ticks = 0;  // count of the 12 MHz clock
    std::vector<std::uint8_t> message;
  };
  // Takes bytes. Returns the long frames that are now complete.
  std::vector<Frame> take(std::span<const std::uint8_t> bytes);

 private:
  // Bytes since the escape that begins the frame, without escapes.
  std::vector<std::uint8_t> frame_;
  bool is_inside_ = false, is_escaped_ = false;
};

// Converts a receiver's counter to this host's time. The counter has no time of day, and each frame
// arrives with another delay. The frame with the least delay determines the time of the first
// frame.
class TickClock {
 public:
  // The time [us] from the first frame to this frame, which arrived at `arrival_utime_us`.
  std::int64_t take(std::uint64_t ticks, std::int64_t arrival_utime_us);
  // The time of the first frame, from all frames so far.
  std::int64_t first_utime_us() const { return first_utime_us_; }

 private:
  std::optional<std::uint64_t> first_ticks_;
  std::int64_t first_utime_us_ = 0;
};

// The delay of messages, measured by the receiver's own stamps. No message arrives before it was
// sent, and at least one of many messages has almost no delay. Therefore, the least delay is the
// offset between the clocks of this host and of the receiver.
class ReceiverDelay {
 public:
  void note(std::int64_t stamp_utime_us, std::int64_t arrival_utime_us);
  // The least delay [us] so far; nullopt: no message had a stamp.
  std::optional<std::int64_t> least_us() const { return least_us_; }

 private:
  std::optional<std::int64_t> least_us_;
};

// Reads a line of SBS, port 30003; nullopt if it has no position. Heights are normally barometric;
// they are usable only if the receiver is configured to write geometric heights. Times have no time
// zone; they are taken as UTC.
std::optional<AircraftPosition> sbs_position(const std::string& line);

struct AircraftSnapshot {
  std::int64_t utime_us = 0;  // `now`, by the receiver's clock
  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
};
// Reads aircraft.json of readsb or dump1090. The time of a position is `now` minus `seen_pos`, its
// height is `alt_geom`. Throws std::runtime_error for any other text.
AircraftSnapshot aircraft_json(const std::string& text);

}  // namespace ols::calibration
