#include "base/bus/channel_pattern.h"

#include <glib.h>

#include <algorithm>
#include <stdexcept>

namespace ols {
namespace {

constexpr std::string_view kAnything = ".*";

bool is_plain(std::string_view text) {
  return std::ranges::all_of(text, [](char c) {
    return g_ascii_isalnum(c) || c == '_' || c == '-' || c == '/';  // NOLINT: a GLib macro
  });
}

std::shared_ptr<GRegex> compile(const std::string& regex) {
  GError* failure = nullptr;
  // \z: $ would also match before a final newline.
  const std::string whole = "(?:" + regex + ")\\z";
  GRegex* compiled = g_regex_new(whole.c_str(), G_REGEX_ANCHORED, GRegexMatchFlags{}, &failure);
  if (compiled != nullptr) return {compiled, g_regex_unref};
  const std::string why = failure->message;
  g_error_free(failure);
  throw std::invalid_argument("\"" + regex + "\" is not a regular expression: " + why);
}

}  // namespace

ChannelPattern::ChannelPattern(const std::string& regex) : kind_(Kind::kName), text_(regex) {
  if (is_plain(text_)) return;
  const bool open = regex.ends_with(kAnything);
  if (open) text_.resize(regex.size() - kAnything.size());
  kind_ = open && is_plain(text_) ? Kind::kBeginning : Kind::kExpression;
  if (kind_ == Kind::kExpression) expression_ = compile(regex);
}

bool ChannelPattern::matches(std::string_view channel) const {
  switch (kind_) {
    case Kind::kName:
      return channel == text_;
    case Kind::kBeginning:
      return channel.starts_with(text_);
    case Kind::kExpression:
      return g_regex_match_full(expression_.get(), channel.data(),
                                static_cast<gssize>(channel.size()), 0, GRegexMatchFlags{}, nullptr,
                                nullptr) != 0;
  }
  return false;
}

}  // namespace ols
