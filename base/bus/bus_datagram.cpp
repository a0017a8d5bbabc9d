#include "base/bus/bus_datagram.h"

#include <algorithm>

namespace ols {
namespace {

// Big-endian: "LC02", "LC03".
constexpr std::uint32_t kWhole = 0x4c433032, kFragment = 0x4c433033;
constexpr std::size_t kHeader = 8;  // [byte] magic, sequence

std::uint32_t big_endian(std::span<const std::uint8_t, 4> bytes) {
  std::uint32_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8U | byte;
  return value;
}

void append(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) {
    bytes.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

bool is_channel(std::string_view name) {
  return !name.empty() && name.size() <= kLongestChannel &&
         std::ranges::all_of(name, [](char c) { return c > ' ' && c <= '~'; });
}

}  // namespace

std::variant<BusDatagram, DatagramFault> parse_datagram(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kHeader) return DatagramFault::kForeign;
  const std::uint32_t magic = big_endian(bytes.subspan<0, 4>());
  if (magic == kFragment) return DatagramFault::kFragment;
  if (magic != kWhole) return DatagramFault::kForeign;
  const auto rest = bytes.subspan(kHeader);
  const auto name = rest.first(std::min(rest.size(), kLongestChannel + 1));
  const auto end = std::ranges::find(name, std::uint8_t{0});
  if (end == name.end()) return DatagramFault::kChannel;
  const auto length = static_cast<std::size_t>(end - name.begin());
  const std::string_view channel(reinterpret_cast<const char*>(name.data()), length);
  if (!is_channel(channel)) return DatagramFault::kChannel;
  return BusDatagram{big_endian(bytes.subspan<4, 4>()), channel, rest.subspan(length + 1)};
}

std::vector<std::uint8_t> make_datagram(std::uint32_t sequence, std::string_view channel,
                                        std::span<const std::uint8_t> payload) {
  std::vector<std::uint8_t> bytes;
  const std::size_t size = kHeader + channel.size() + 1 + payload.size();
  if (!is_channel(channel) || size > kLargestDatagram) return bytes;
  bytes.reserve(size);
  append(bytes, kWhole);
  append(bytes, sequence);
  bytes.insert(bytes.end(), channel.begin(), channel.end());
  bytes.push_back(0);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  return bytes;
}

}  // namespace ols
