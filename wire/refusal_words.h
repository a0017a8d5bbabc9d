// The words for a person about a refusal. Pure.
#pragma once

#include <string>

#include "wire/order.h"

namespace ols::wire {

// "refused: that picture is too old; ..". For a reply that refuses.
std::string refusal_in_words(const Reply& reply);

}  // namespace ols::wire
