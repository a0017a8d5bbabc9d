// SAPIENT over a stream of bytes: each message follows its length, four bytes, the least
// significant first. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ols::exports {

inline constexpr std::size_t kFrameHead_bytes = 4;

// The message with its length before it.
std::string framed(const std::string& message);
// Of the message at the beginning of the bytes; nothing: its length is not complete yet.
std::optional<std::size_t> framed_length(std::string_view bytes);

}  // namespace ols::exports
