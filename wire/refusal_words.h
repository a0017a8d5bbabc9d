// Explains a refusal in words for a person. Pure.
#pragma once

#include "conditions/refusal.h"
#include "wire/order.h"

namespace ols::wire {

// Returns for example "refused: that picture is too old; ..". `reply` must be a refusal.
Outcome refusal_in_words(const Reply& reply);

}  // namespace ols::wire
