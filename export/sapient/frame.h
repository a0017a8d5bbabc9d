// SAPIENT messages in a stream of bytes. Before each message, four bytes state its length, least
// significant byte first. Pure.
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
// Size of the framed message with which the bytes begin; nullopt: its length is not complete yet.
std::optional<std::size_t> framed_length(std::string_view bytes);

}  // namespace ols::exports
