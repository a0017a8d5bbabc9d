#include "wire/refusal_words.h"

#include <string_view>

#include "conditions/refusal.h"

namespace ols::wire {

std::string refusal_in_words(const Reply& reply) {
  const std::string_view words = refusal_sentence(reply.reason);
  std::string text = "refused: " + (words.empty() ? reply.reason : std::string(words));
  if (!reply.detail.empty()) text += ": " + reply.detail;
  return text;
}

}  // namespace ols::wire
