// Text of others made fit for a terminal, a journal or a page.
#pragma once

#include <string>
#include <string_view>

namespace ols {

// What a person can read stays, in UTF-8; every control character, escape sequence's beginning,
// direction mark and damaged byte becomes "?". So text from a wire moves no cursor, hides nothing
// and is one line.
std::string plain_text(std::string_view text);

}  // namespace ols
