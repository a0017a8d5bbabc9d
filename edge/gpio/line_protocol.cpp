#include "edge/gpio/line_protocol.h"

#include <algorithm>
#include <charconv>
#include <system_error>

namespace ols::gpio {
namespace {

// "in 17 1"
std::optional<LineProtocol::Level> parse(std::string_view text) {
  if (!text.starts_with("in ")) return std::nullopt;
  text.remove_prefix(3);
  int line = -1;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), line);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || line < 0 || (rest != " 0" && rest != " 1")) return std::nullopt;
  return LineProtocol::Level{line, rest == " 1"};
}

}  // namespace

std::optional<std::vector<LineProtocol::Level>> LineProtocol::receive(std::string_view bytes) {
  std::vector<Level> levels;
  pending_.append(bytes);
  std::size_t end = 0;
  while ((end = pending_.find('\n')) != std::string::npos) {
    if (end > kLongestLine) return std::nullopt;
    const auto message = parse(std::string_view(pending_).substr(0, end));
    if (!message) return std::nullopt;
    pending_.erase(0, end + 1);
    if (std::ranges::count(inputs_, message->line) != 0) levels.push_back(*message);
  }
  if (pending_.size() > kLongestLine) return std::nullopt;
  return levels;
}

}  // namespace ols::gpio
