// What a server of GPIO lines says over its socket, byte by byte (gpio_lines.h has the protocol).
// Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols {

class LineProtocol {
 public:
  // Of which line the levels are wanted; those of others are passed over.
  explicit LineProtocol(int input) : input_(input) {}

  // The levels (true: high) that these bytes complete, oldest first; nothing when there is
  // something among them that is no level. That ends the connection, and with it this object.
  std::optional<std::vector<bool>> receive(std::string_view bytes);

 private:
  static constexpr std::size_t kLongestLine = 64;

  int input_;
  std::string pending_;  // a line that has begun
};

}  // namespace ols
