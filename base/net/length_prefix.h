// Messages in a stream of bytes. The length of each comes before it, in four bytes, most
// significant first. Pure.
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
// nullopt if the message is empty or longer than `max_bytes`: the peer does not use this protocol,
// and the start of the next message is unknown.
std::optional<std::uint32_t> message_length(const LengthPrefix& prefix, std::uint32_t max_bytes);

}  // namespace ols
