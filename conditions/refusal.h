// Why something is refused, as a sentence for a person. Pure.
#pragma once

#include <string>
#include <string_view>

namespace ols {

// The sentence of conditions.toml for a reason that programs count ("no_frame"); empty: it has
// none.
std::string_view refusal_sentence(std::string_view reason);
// "SLEW refused: it came too late; ...". A reason without a sentence stands for itself.
std::string refused_in_words(const std::string& what, const std::string& reason);

}  // namespace ols
