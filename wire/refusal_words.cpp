#include "wire/refusal_words.h"

#include <cctype>
#include <string_view>

#include "conditions/refusal.h"

namespace ols::wire {
std::string error_in_words(const std::string& error) {
  constexpr std::string_view kRefused = " refused: ";
  const std::size_t at = error.find(kRefused);
  if (at == std::string::npos) return error;
  const std::string_view words =
      refusal_sentence(std::string_view(error).substr(at + kRefused.size()));
  if (words.empty()) return error;
  std::string what = error.substr(0, at);
  for (char& c : what) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return what + std::string(kRefused) + std::string(words);
}

std::string refusal_in_words(const Reply& reply) {
  const std::string_view words = refusal_sentence(reply.reason);
  std::string text = "refused: " + (words.empty() ? reply.reason : std::string(words));
  if (!reply.detail.empty()) text += ": " + reply.detail;
  return text;
}

}  // namespace ols::wire
