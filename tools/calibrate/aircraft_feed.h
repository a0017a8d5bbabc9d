// What receivers of aircraft write: Beast's binary frames, SBS's lines, readsb's aircraft.json.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "calibration/adsb.h"

namespace ols::calibration {

// Beast, port 30005: Mode S frames with a counter of 12 MHz, out of a stream in any pieces.
class BeastFrames {
 public:
  struct Frame {
    std::uint64_t ticks = 0;  // of 12 MHz
    std::vector<std::uint8_t> message;
  };
  // The long frames that the bytes complete.
  std::vector<Frame> take(std::span<const std::uint8_t> bytes);

 private:
  std::vector<std::uint8_t> frame_;  // after its escape, without escapes
  bool is_inside_ = false, is_escaped_ = false;
};

// A receiver's counter as times of this host: it has no time of day, and a frame is late by the way
// it takes. The frame that came with the least delay tells when the first one was heard.
class TickClock {
 public:
  // [us] From the first frame to this one, which arrived here at `arrival_utime_us`.
  std::int64_t take(std::uint64_t ticks, std::int64_t arrival_utime_us);
  // Of the first frame, by all so far.
  std::int64_t first_utime_us() const { return first_utime_us_; }

 private:
  std::optional<std::uint64_t> first_ticks_;
  std::int64_t first_utime_us_ = 0;
};

// How late a receiver's own stamps come here. Nothing comes before it was sent, and of many
// messages one hardly waits on its way: the least delay is what one clock is ahead of the other by.
class ReceiverDelay {
 public:
  void note(std::int64_t stamp_utime_us, std::int64_t arrival_utime_us);
  // [us] Of all so far; empty: nothing was stamped.
  std::optional<std::int64_t> least_us() const { return least_us_; }

 private:
  std::optional<std::int64_t> least_us_;
};

// A line of SBS, port 30003. Nothing unless it has a position. Its height is barometric: only where
// the receiver is told to write geometric ones is it of use. Its times have no zone: taken as UTC.
std::optional<AircraftPosition> sbs_position(const std::string& line);

struct AircraftSnapshot {
  std::int64_t utime_us = 0;  // its `now`: by the receiver's clock
  std::vector<AircraftPosition> positions;
  int barometric_only = 0;
};
// aircraft.json of readsb and dump1090: `now` less `seen_pos`, `alt_geom`. std::runtime_error for
// what is no such text.
AircraftSnapshot aircraft_json(const std::string& text);

}  // namespace ols::calibration
