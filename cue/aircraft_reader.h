// What receivers of aircraft write: aircraft.json of readsb and dump1090, and SBS (BaseStation),
// port 30003. Pure.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "cue/reading.h"

namespace ols::cues {

// A whole file. Places are of `now` less `seen_pos`.
Readings aircraft_json_readings(const std::string& text);

// Lines. An aircraft's place, velocity and call sign come in lines of their own, and the lines'
// times have no zone: that of arrival counts.
class SbsReader {
 public:
  // Nothing for a line that says no place.
  Readings take(const std::string& line, std::int64_t now_us);

 private:
  struct Aircraft {
    std::string callsign;
    std::optional<std::array<double, 3>> velocity_enu_m_s;
    std::int64_t velocity_us = 0;  // when it was said
    std::int64_t heard_us = 0;
  };
  Aircraft& aircraft(const std::string& icao, std::int64_t now_us);

  static constexpr std::size_t kMost = 1000;
  std::map<std::string, Aircraft> aircraft_;
};

}  // namespace ols::cues
