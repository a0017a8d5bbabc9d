// How far a mount's angles can be trusted, and a doubt that is persisted over a restart of the
// process. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::mount {

enum class Reference {
  kUnknown,  // no usable mount
  kMissing,  // the mount must be homed, or it is homing
  kDoubted,  // no samples, and goals are ignored, until it is homed or its reference confirmed
  kTrusted,
};

// A doubted reference is trusted again after a complete homing, or after an operator's reference-ok
// where that is accepted. A trusted reference has no such struct.
struct ReferenceDoubt {
  bool homing_broken_off = false;  // or still under way; a homing is not repeated automatically
  // Some units do not know their step size until they are homed: reference-ok is not accepted.
  bool gears_lost = false;

  bool operator==(const ReferenceDoubt&) const = default;
};

// All possible words of the persisted form, which is a single word. The first stands for a trusted
// reference.
const std::vector<std::string>& doubt_words();
std::string to_word(const std::optional<ReferenceDoubt>& doubt);
// A word that is not one of doubt_words() counts as the most serious doubt.
std::optional<ReferenceDoubt> doubt_from_word(std::string_view word);

}  // namespace ols::mount
