// Finds this host's PTUs and GNSS receivers. Moves nothing.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ols::setup {

// The entries of a folder whose names have this beginning, sorted; empty: there is no such folder.
std::vector<std::string> devices_in(const std::string& folder, const std::string& beginning);

// The serial adapters, by stable names where there are any (/dev/ols/*, /dev/serial/by-id/*),
// otherwise /dev/ttyUSB* and ttyACM*.
std::vector<std::string> serial_lines();

// A line on which a PTU answers, with the unit's version and baud rate.
struct FoundPtu {
  std::string device, version;
  int baud = 0;
};
std::vector<FoundPtu> find_ptus(const std::vector<std::string>& lines);

// The lines on which a GNSS receiver sends NMEA sentences or UBX messages.
std::vector<std::string> find_receivers(const std::vector<std::string>& lines);
// Whether these bytes are part of a receiver's output. Pure.
bool is_receiver_talk(const std::string& bytes);

}  // namespace ols::setup
