// Messages in the form in which they are on the bus, for the tests of the bridge.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ols_msg/bearing_t.hpp"
#include "ols_msg/slew_t.hpp"
#include "ols_msg/station_status_t.hpp"
#include "ols_msg/target_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::bridge {

inline constexpr std::int64_t kNow_us = 1'700'000'000'000'000;

inline std::vector<std::uint8_t> bearing(const std::string& station, std::int64_t sequence = 1,
                                         std::int64_t boot_id = 7) {
  ols_msg::bearing_t message{};
  message.utime = kNow_us;
  message.station = station;
  message.boot_id = boot_id;
  message.sequence = sequence;
  return encoded(message);
}

inline std::vector<std::uint8_t> slew(const std::string& station, double age_s = 0.0,
                                      std::int64_t target_id = 3) {
  ols_msg::slew_t message{};
  message.utime = kNow_us - static_cast<std::int64_t>(age_s * 1e6);
  message.station = station;
  message.boot_id = 9;
  message.sequence = 1;
  message.target_id = target_id;
  return encoded(message);
}

inline std::vector<std::uint8_t> target(std::int64_t target_id) {
  ols_msg::target_t message{};
  message.utime = kNow_us;
  message.boot_id = 9;
  message.sequence = 12;
  message.target_id = target_id;
  return encoded(message);
}

}  // namespace ols::bridge
