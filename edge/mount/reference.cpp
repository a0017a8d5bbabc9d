#include "edge/mount/reference.h"

#include <cstddef>

namespace ols::mount {

const std::vector<std::string>& doubt_words() {
  static const std::vector<std::string> kWords{"none", "reference", "homing", "gears",
                                               "homing-gears"};
  return kWords;
}

std::string to_word(const std::optional<ReferenceDoubt>& doubt) {
  if (!doubt) return doubt_words().front();
  const std::size_t index = 1 + (doubt->homing_broken_off ? 1 : 0) + (doubt->gears_lost ? 2 : 0);
  return doubt_words().at(index);
}

std::optional<ReferenceDoubt> doubt_from_word(std::string_view word) {
  if (word == doubt_words().front()) return std::nullopt;
  for (const ReferenceDoubt& doubt : {ReferenceDoubt{false, false}, {true, false}, {false, true}}) {
    if (word == to_word(doubt)) return doubt;
  }
  return ReferenceDoubt{true, true};
}

}  // namespace ols::mount
