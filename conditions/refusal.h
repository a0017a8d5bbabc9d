// Explains to a person, in words, why something was refused. Pure.
#pragma once

#include <string>
#include <string_view>

#include "conditions/alarm.h"

namespace ols {

// The outcome of an order. Empty: the order is carried out. Otherwise the reason why not: like an
// alarm, an outcome is a row of conditions.toml with values for its parameters. The functions of
// conditions/sayings.h make outcomes.
using Outcome = Alarm;

// Programs count refusals by reason ("no_frame"). Returns the sentence of conditions.toml for a
// reason; empty: the reason has no sentence.
std::string_view refusal_sentence(std::string_view reason);
// As refusal_sentence(), but returns the reason itself if it has no sentence. `of`: a prefix of the
// reason, such as "bridge_", for a program whose reasons have the same names as another program's.
std::string refusal_words(const std::string& reason, const std::string& of = {});
// "SLEW refused: it came too late; ...".
std::string refused_in_words(const std::string& what, const std::string& reason);

}  // namespace ols
