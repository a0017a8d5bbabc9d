// FNV-1a (Fowler, Noll, Vo), 64 bits: a hash of a text that is the same on every machine. It
// detects accidents, not forgeries.
#pragma once

#include <cstdint>
#include <string_view>

namespace ols {

// `before`: the hash of the text that this text continues, if any.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t before = 0xcbf29ce484222325U) {
  for (const char byte : text)
    before = (before ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return before;
}

static_assert(fnv1a("a") == 0xaf63dc4c8601ec8cU);  // RFC 9923

}  // namespace ols
