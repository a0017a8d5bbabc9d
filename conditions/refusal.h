// Why something is refused, as a sentence for a person. Pure.
#pragma once

#include <string>
#include <string_view>

#include "conditions/alarm.h"

namespace ols {

// What comes of an order that is not carried out: a row of the table's outcomes with its
// parameters, like an alarm. conditions/sayings.h makes them. Empty: the order is carried out.
using Outcome = Alarm;

// The sentence of conditions.toml for a reason that programs count ("no_frame"); empty: it has
// none.
std::string_view refusal_sentence(std::string_view reason);
// The same; a reason without a sentence stands for itself. `of`: whose reason it is, where several
// have one of this name ("bridge_").
std::string refusal_words(const std::string& reason, const std::string& of = {});
// "SLEW refused: it came too late; ...".
std::string refused_in_words(const std::string& what, const std::string& reason);

}  // namespace ols
