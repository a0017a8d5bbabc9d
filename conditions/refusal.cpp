#include "conditions/refusal.h"

namespace ols {

std::string refused_in_words(const std::string& what, const std::string& reason) {
  const std::string_view sentence = refusal_sentence(reason);
  return what + " refused: " + (sentence.empty() ? reason : std::string(sentence));
}

}  // namespace ols
