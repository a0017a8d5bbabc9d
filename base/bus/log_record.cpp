#include "base/bus/log_record.h"

#include <algorithm>
#include <array>

namespace ols {
namespace {

constexpr std::array<std::uint8_t, 4> kSync{0xED, 0xA1, 0xDA, 0x01};
constexpr std::size_t kHeaderBytes = 28;
constexpr std::size_t kMostChannelBytes = 63;  // of a channel's name in LCM

std::uint64_t number(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

bool is_printable(std::string_view channel) {
  return std::ranges::all_of(channel, [](char c) { return c > ' ' && c < 127; });
}

// Up to the next byte at which a record may begin.
LogGarbage until_next(std::span<const std::uint8_t> bytes) {
  const auto next = std::find(bytes.begin() + 1, bytes.end(), kSync[0]);
  return {static_cast<std::size_t>(next - bytes.begin())};
}

}  // namespace

std::variant<LogRecord, LogGarbage, LogNeedsMore> parse_log_record(
    std::span<const std::uint8_t> bytes) {
  const std::size_t beginning = std::min(bytes.size(), kSync.size());
  if (!std::equal(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(beginning),
                  kSync.begin())) {
    return until_next(bytes);
  }
  if (bytes.size() < kHeaderBytes) return LogNeedsMore{kHeaderBytes};
  const std::uint64_t channel_bytes = number(bytes.subspan(20, 4));
  const std::uint64_t payload_bytes = number(bytes.subspan(24, 4));
  if (channel_bytes == 0 || channel_bytes > kMostChannelBytes || payload_bytes > kMostRecordBytes) {
    return until_next(bytes);
  }
  const std::size_t all = kHeaderBytes + channel_bytes + payload_bytes;
  if (bytes.size() < kHeaderBytes + channel_bytes) return LogNeedsMore{all};
  const std::string_view channel(reinterpret_cast<const char*>(bytes.data()) + kHeaderBytes,
                                 channel_bytes);
  if (!is_printable(channel)) return until_next(bytes);
  if (bytes.size() < all) return LogNeedsMore{all};
  return LogRecord{static_cast<std::int64_t>(number(bytes.subspan(12, 8))), channel,
                   bytes.subspan(kHeaderBytes + channel_bytes, payload_bytes), all};
}

std::vector<std::uint8_t> log_record_bytes(std::uint64_t number, std::int64_t utime_us,
                                           std::string_view channel,
                                           std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> bytes(kSync.begin(), kSync.end());
  const auto append = [&bytes](std::uint64_t value, std::size_t size) {
    for (std::size_t i = size; i > 0; --i) {
      bytes.push_back(static_cast<std::uint8_t>(value >> (8U * (i - 1))));
    }
  };
  append(number, 8);
  append(static_cast<std::uint64_t>(utime_us), 8);
  append(channel.size(), 4);
  append(payload.size(), 4);
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

}  // namespace ols
