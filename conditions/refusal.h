// Says in words for a person why something was refused. Pure.
#pragma once

#include <string>
#include <string_view>

#include "conditions/alarm.h"

namespace ols {

// Why an order is not carried out: a row of the table's outcomes with its parameters, like an
// alarm. conditions/sayings.h makes them. Empty: the order is carried out.
using Outcome = Alarm;

// The sentence of conditions.toml for a reason that programs count ("no_frame"); empty: the reason
// has no sentence.
std::string_view refusal_sentence(std::string_view reason);
// The same, but the reason itself if it has no sentence. `of`: a prefix that tells reasons of the
// same name apart ("bridge_").
std::string refusal_words(const std::string& reason, const std::string& of = {});
// "SLEW refused: it came too late; ...".
std::string refused_in_words(const std::string& what, const std::string& reason);

}  // namespace ols
