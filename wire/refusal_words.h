// The words for a person about a refusal. Pure.
#pragma once

#include "conditions/refusal.h"
#include "wire/order.h"

namespace ols::wire {

// "refused: that picture is too old; ..". For a reply that refuses.
Outcome refusal_in_words(const Reply& reply);

}  // namespace ols::wire
