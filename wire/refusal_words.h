// What a person is told of a refusal. Pure.
#pragma once

#include <string>

#include "wire/order.h"

namespace ols::wire {

// "refused: that picture is too old; ..". Of a reply that refuses.
std::string refusal_in_words(const Reply& reply);

}  // namespace ols::wire
