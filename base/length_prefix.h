// Messages over a stream of bytes: each follows its length, four bytes, the most significant first.
// Pure.
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
// Empty if the message is empty or longer than `max_bytes`: whoever sends this does not speak the
// language, and where the next message begins is unknown.
std::optional<std::uint32_t> message_length(const LengthPrefix& prefix, std::uint32_t max_bytes);

}  // namespace ols
