// What a person is told of a refusal. Pure.
#pragma once

#include <string>

#include "wire/order.h"

namespace ols::wire {

// "refused: that picture is too old; ..". Of a reply that refuses.
std::string refusal_in_words(const Reply& reply);

// A station's last error with its reason in words: "DESIGNATE refused: no_frame" becomes
// "designate refused: that picture is too old; ...".
std::string error_in_words(const std::string& error);

}  // namespace ols::wire
