// Finds this host's cameras, PTU and GNSS receiver. Nothing is moved.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ols::setup {

// Serial adapters by stable names: /dev/ols/*, /dev/serial/by-id/*, otherwise /dev/ttyUSB* and
// ttyACM*.
std::vector<std::string> serial_lines();

// The lines on which a unit answers, with its version: (device, version).
struct FoundPtu {
  std::string device, version;
  int baud = 0;
};
std::vector<FoundPtu> find_ptus(const std::vector<std::string>& lines);

// The lines on which a GNSS receiver sends NMEA sentences or UBX.
std::vector<std::string> find_receivers(const std::vector<std::string>& lines);
// Whether these bytes are part of a receiver's output. Pure.
bool is_receiver_talk(const std::string& bytes);

}  // namespace ols::setup
