#include "edge/ptu/reference_doubt.h"

#include <cstddef>

namespace ols::ptu {

const char* describe(PtuDoubtCause cause) {
  switch (cause) {
    case PtuDoubtCause::kPowerCycle:
      return "lost power and was not seen to home since: home it, or reference-ok once "
             "it was checked";
    case PtuDoubtCause::kLimitHit:
      return "ran into a limit and may have lost steps: home it, or reference-ok once it was "
             "checked";
    case PtuDoubtCause::kHomingInterrupted:
      return "homing was interrupted: home it, or reference-ok once it was checked";
    case PtuDoubtCause::kBeforeStart:
      return "its reference was in doubt already before this start: home it, or reference-ok once "
             "it was checked";
  }
  return "";
}

const std::vector<std::string>& doubt_words() {
  static const std::vector<std::string> kWords{"none", "reference", "homing", "gears",
                                               "homing-gears"};
  return kWords;
}

std::string to_word(const std::optional<PtuReferenceDoubt>& doubt) {
  if (!doubt) return doubt_words().front();
  const std::size_t index = 1 + (doubt->homing_broken_off ? 1 : 0) + (doubt->gears_lost ? 2 : 0);
  return doubt_words().at(index);
}

std::optional<PtuReferenceDoubt> doubt_from_word(std::string_view word) {
  if (word == doubt_words().front()) return std::nullopt;
  for (const PtuReferenceDoubt& doubt :
       {PtuReferenceDoubt{false, false}, {true, false}, {false, true}}) {
    if (word == to_word(doubt)) return doubt;
  }
  return PtuReferenceDoubt{true, true};
}

}  // namespace ols::ptu
