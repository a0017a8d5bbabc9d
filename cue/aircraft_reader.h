// Reads the output of aircraft receivers in two formats: aircraft.json of readsb and dump1090, and
// SBS (BaseStation), which receivers send on port 30003. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cue/reading.h"

namespace ols::cues {

// Reads the text of a whole aircraft.json. The time of a position is `now` minus `seen_pos`, both
// as the file states them.
Readings aircraft_json_readings(const std::string& text);

// Reads SBS line by line. An aircraft's position, velocity and call sign come in separate lines.
// The times in the lines have no time zone; therefore the time of arrival is used.
class SbsReader {
 public:
  // Returns no reading for a line without a position. `now_us`: time of arrival, UTC.
  Readings take(const std::string& line, std::int64_t now_us);

 private:
  struct Aircraft {
    std::string callsign;
    std::optional<std::array<double, 3>> velocity_enu_m_s;
    std::int64_t velocity_us = 0;  // time of the line with the velocity
    std::int64_t heard_us = 0;
  };
  Aircraft& aircraft(const std::string& icao, std::int64_t now_us);

  static constexpr std::size_t kMost = 1000;
  std::map<std::string, Aircraft> aircraft_;
};

}  // namespace ols::cues
