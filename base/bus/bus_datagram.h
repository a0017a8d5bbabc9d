// A datagram of the bus: one whole LCM message ("LC02"). Pure.
//
// LCM cuts a message that does not fit into one datagram into fragments ("LC03"). No message of
// this system is that large. The reassembly in liblcm 1.3.1 adds offset and length of a fragment as
// 32-bit numbers. The sum can overflow, so that a forged fragment makes liblcm write beyond its
// buffer (https://github.com/lcm-proj/lcm/pull/628). Fragments are therefore refused here, and
// liblcm never sees a datagram.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

namespace ols {

// [byte] LCM's own limit, LCM_MAX_CHANNEL_NAME_LENGTH.
inline constexpr std::size_t kLongestChannel = 63;
// [byte] The largest payload of a UDP datagram over IPv4.
inline constexpr std::size_t kLargestDatagram = 65507;

// Views into the parsed datagram.
struct BusDatagram {
  std::uint32_t sequence = 0;  // the number of the datagram; the sender counts all channels
                               // together
  std::string_view channel;    // 1 to kLongestChannel printable ASCII characters without a space
  std::span<const std::uint8_t> payload;
};

enum class DatagramFault {
  kFragment,  // part of a message that was cut into several datagrams
  kForeign,   // not LCM, or it ends within its header
  kChannel,   // the channel name is empty, has no end, is too long or is not printable
};

std::variant<BusDatagram, DatagramFault> parse_datagram(std::span<const std::uint8_t> bytes);

// Empty if the channel name is invalid, or if the message does not fit into a datagram.
std::vector<std::uint8_t> make_datagram(std::uint32_t sequence, std::string_view channel,
                                        std::span<const std::uint8_t> payload);

}  // namespace ols
