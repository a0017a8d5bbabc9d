// Doubt about a unit's reference: whether its step counter still matches the position of the head.
// It is persisted over a restart of the process. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::ptu {

// Why the reference is in doubt.
enum class PtuDoubtCause { kPowerCycle, kLimitHit, kHomingInterrupted, kBeforeStart };
// What is wrong and what to do about it.
const char* describe(PtuDoubtCause cause);

// A doubted reference is trusted again after a complete homing, or after an operator's reference-ok
// where that is accepted. A trusted reference is the absence of this struct.
struct PtuReferenceDoubt {
  bool homing_broken_off = false;  // or still under way; a homing is not repeated automatically
  // Some units do not know their step size until they are homed: reference-ok is not accepted.
  bool gears_lost = false;

  bool operator==(const PtuReferenceDoubt&) const = default;
};

// The persisted form is one word. All of the words; the first one stands for a trusted reference.
const std::vector<std::string>& doubt_words();
std::string to_word(const std::optional<PtuReferenceDoubt>& doubt);
// A word that is not one of doubt_words() counts as the most serious doubt.
std::optional<PtuReferenceDoubt> doubt_from_word(std::string_view word);

}  // namespace ols::ptu
