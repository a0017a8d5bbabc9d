// SAPIENT in a stream of bytes. The length of each message comes before it, in four bytes, least
// significant first. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ols::exports {

inline constexpr std::size_t kFrameHead_bytes = 4;

// The message, preceded by its length.
std::string framed(const std::string& message);
// Size of the framed message at the beginning of the bytes; nullopt: its length is incomplete.
std::optional<std::size_t> framed_length(std::string_view bytes);

}  // namespace ols::exports
