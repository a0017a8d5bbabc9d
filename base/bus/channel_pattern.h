// Selects channels by a regular expression (GLib's, as in LCM) that must match the whole name.
// Plain names and prefixes ("NAME.*") are compared directly.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct _GRegex;

namespace ols {

class ChannelPattern {
 public:
  // Throws std::invalid_argument that says what is wrong with the expression.
  explicit ChannelPattern(const std::string& regex);

  bool matches(std::string_view channel) const;

 private:
  enum class Kind { kName, kBeginning, kExpression };
  Kind kind_;
  std::string text_;
  std::shared_ptr<_GRegex> expression_;
};

}  // namespace ols
