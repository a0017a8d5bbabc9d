// A message that is passed on unchanged, with its signature. RawMessage has only those members of
// an LCM type that are needed for sending.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bridge/passage.h"

namespace ols::bridge {

struct RawMessage {
  Bytes bytes;

  int getEncodedSize() const { return static_cast<int>(bytes.size()); }
  int encode(void* buffer, int offset, int) const {
    std::ranges::copy(bytes, static_cast<std::uint8_t*>(buffer) + offset);
    return getEncodedSize();
  }
};

}  // namespace ols::bridge
