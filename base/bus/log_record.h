// One record of an LCM log, as lcm-logger and ols-logger write it: the sync word EDA1DA01, event
// number and time [us UTC] of eight bytes each, lengths of channel and data of four bytes each, all
// most significant byte first; then the channel and the data (LCM, lcm/eventlog.c). LCM's own
// reader ends at the first damaged length, and allocates whatever memory a record claims. This one
// continues behind the damage. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace ols {

struct LogRecord {
  std::int64_t utime_us = 0;
  std::string_view channel;
  std::span<const std::uint8_t> payload;
  std::size_t bytes = 0;  // of the whole record
};
// No record begins within this many bytes.
struct LogGarbage {
  std::size_t bytes = 0;
};
// Too few bytes to decide: this many are needed in all.
struct LogNeedsMore {
  std::size_t bytes = 0;
};

inline constexpr std::size_t kMostRecordBytes = 4'000'000;  // of a channel's name and data

std::variant<LogRecord, LogGarbage, LogNeedsMore> parse_log_record(
    std::span<const std::uint8_t> bytes);

// The inverse. `number` counts the events of a log from 0.
std::vector<std::uint8_t> log_record_bytes(std::uint64_t number, std::int64_t utime_us,
                                           std::string_view channel,
                                           std::span<const std::uint8_t> payload);

}  // namespace ols
