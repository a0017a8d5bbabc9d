#include "conditions/refusal.h"

namespace ols {

std::string refusal_words(const std::string& reason, const std::string& of) {
  const std::string_view sentence = refusal_sentence(of + reason);
  return sentence.empty() ? reason : std::string(sentence);
}

std::string refused_in_words(const std::string& what, const std::string& reason) {
  return what + " refused: " + refusal_words(reason);
}

}  // namespace ols
