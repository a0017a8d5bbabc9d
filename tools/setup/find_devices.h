// Which camera, PTU and GNSS receiver this host has. Nothing is moved.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace ols::setup {

// Serial adapters by names that stay: /dev/ols/*, /dev/serial/by-id/*, else /dev/ttyUSB* and
// ttyACM*.
std::vector<std::string> serial_lines();

// Those on which a unit answers, with its version: (device, version).
struct FoundPtu {
  std::string device, version;
  int baud = 0;
};
std::vector<FoundPtu> find_ptus(const std::vector<std::string>& lines);

// Those that speak as a receiver does: NMEA sentences or UBX.
std::vector<std::string> find_receivers(const std::vector<std::string>& lines);
// Whether this is part of what a receiver sends. Pure.
bool is_receiver_talk(const std::string& bytes);

}  // namespace ols::setup
