// Messages in a stream of bytes. Before each message, four bytes state its length, most significant
// byte first. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace ols {

inline constexpr std::size_t kLengthPrefix_bytes = 4;
using LengthPrefix = std::array<std::uint8_t, kLengthPrefix_bytes>;

LengthPrefix length_prefix(std::uint32_t length);
// The length that the prefix states. nullopt if it is 0 or more than `max_bytes`: then the peer
// does not use this protocol, and nobody knows where the next message starts.
std::optional<std::uint32_t> message_length(const LengthPrefix& prefix, std::uint32_t max_bytes);

}  // namespace ols
