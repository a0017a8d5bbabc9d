// Whether a mount's angles can be trusted (see "reference" in the glossary), and the doubt about
// them that is saved for the next start of the program. Pure.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ols::mount {

enum class Reference {
  kUnknown,  // there is no usable mount
  kMissing,  // the mount must be homed, or is homing
  // The mount gives no samples and ignores goals until it is homed, or a person confirms its
  // reference.
  kDoubted,
  kTrusted,
};

// The reason why a reference is in doubt. The reference is trusted again after a complete homing,
// or after an operator's order reference-ok, if the mount accepts that order. A trusted reference
// has no ReferenceDoubt.
struct ReferenceDoubt {
  // A homing was interrupted, or is still in progress. An interrupted homing is not repeated
  // automatically.
  bool homing_broken_off = false;
  // The mount does not know its step size until it is homed. It therefore does not accept
  // reference-ok.
  bool gears_lost = false;

  bool operator==(const ReferenceDoubt&) const = default;
};

// All words that can be saved. The first one means a trusted reference; each of the others means
// one value of ReferenceDoubt.
const std::vector<std::string>& doubt_words();
std::string to_word(const std::optional<ReferenceDoubt>& doubt);
// An unknown word means the most serious doubt.
std::optional<ReferenceDoubt> doubt_from_word(std::string_view word);

}  // namespace ols::mount
