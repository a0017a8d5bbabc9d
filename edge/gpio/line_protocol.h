// Parses the messages of a server of GPIO lines, byte by byte (protocol: gpio_lines.h). Pure.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ols::gpio {

class LineProtocol {
 public:
  struct Level {
    int line = 0;
    bool high = false;
    bool operator==(const Level&) const = default;
  };

  // `inputs`: the input lines in use; levels of other lines are ignored.
  explicit LineProtocol(std::vector<int> inputs) : inputs_(std::move(inputs)) {}

  // Takes received bytes. Returns the levels of all messages that these bytes complete, oldest
  // first. nullopt if a message is not a level; the caller must then end the connection and discard
  // this object.
  std::optional<std::vector<Level>> receive(std::string_view bytes);

 private:
  static constexpr std::size_t kLongestLine = 64;

  std::vector<int> inputs_;
  std::string pending_;  // an incomplete message
};

}  // namespace ols::gpio
