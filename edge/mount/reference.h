// How far a mount's angles can be trusted, and the doubt that persists over a restart of the
// process. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::mount {

enum class Reference {
  kUnknown,  // there is no usable mount
  kMissing,  // the mount must be homed, or is homing
  // There are no samples and goals are ignored, until the mount is homed or its reference is
  // confirmed.
  kDoubted,
  kTrusted,
};

// The reason why a reference is doubted. It is trusted again after a complete homing, or after an
// operator's reference-ok if that is accepted. A trusted reference has no ReferenceDoubt.
struct ReferenceDoubt {
  // A homing was interrupted or is still under way; it is not repeated automatically.
  bool homing_broken_off = false;
  // The unit does not know its step size until it is homed, so reference-ok is not accepted.
  bool gears_lost = false;

  bool operator==(const ReferenceDoubt&) const = default;
};

// All words that can be persisted; each stands for one state. The first stands for a trusted
// reference.
const std::vector<std::string>& doubt_words();
std::string to_word(const std::optional<ReferenceDoubt>& doubt);
// A word that is not one of doubt_words() counts as the most serious doubt.
std::optional<ReferenceDoubt> doubt_from_word(std::string_view word);

}  // namespace ols::mount
