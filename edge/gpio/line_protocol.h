// What a server of GPIO lines says over its socket, byte by byte (gpio_lines.h has the protocol).
// Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ols {

class LineProtocol {
 public:
  struct Level {
    int line = 0;
    bool high = false;
    bool operator==(const Level&) const = default;
  };

  // Of which lines the levels are wanted; those of others are passed over.
  explicit LineProtocol(std::vector<int> inputs) : inputs_(std::move(inputs)) {}

  // The levels that these bytes complete, oldest first; nothing when there is
  // something among them that is no level. That ends the connection, and with it this object.
  std::optional<std::vector<Level>> receive(std::string_view bytes);

 private:
  static constexpr std::size_t kLongestLine = 64;

  std::vector<int> inputs_;
  std::string pending_;  // a line that has begun
};

}  // namespace ols
