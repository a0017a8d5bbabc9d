// One record of an LCM log, as lcm-logger and ols-logger write it (LCM, lcm/eventlog.c). In order:
// the sync word EDA1DA01; event number and time [us UTC], eight bytes each; lengths of channel and
// data, four bytes each; the channel; the data. Numbers have the most significant byte first.
//
// LCM's own reader stops at the first damaged length, and allocates as much memory as a record
// claims to need. This reader continues after the damage. Pure.
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
  std::size_t bytes = 0;  // size of the whole record
};
// The first `bytes` bytes belong to no record.
struct LogGarbage {
  std::size_t bytes = 0;
};
// There are too few bytes to decide. `bytes` is the total number needed.
struct LogNeedsMore {
  std::size_t bytes = 0;
};

inline constexpr std::size_t kMostRecordBytes = 4'000'000;  // limit of a record's data

std::variant<LogRecord, LogGarbage, LogNeedsMore> parse_log_record(
    std::span<const std::uint8_t> bytes);

// The bytes of a record. `number` counts the events of a log from 0.
std::vector<std::uint8_t> log_record_bytes(std::uint64_t number, std::int64_t utime_us,
                                           std::string_view channel,
                                           std::span<const std::uint8_t> payload);

}  // namespace ols
