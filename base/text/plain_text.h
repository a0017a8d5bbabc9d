// Makes received text safe for a terminal, the journal or a page.
#pragma once

#include <string>
#include <string_view>

namespace ols {

// Keeps printable UTF-8. Every control character, escape, direction mark and damaged byte becomes
// "?". The result is one line that cannot move a cursor or hide text.
std::string plain_text(std::string_view text);

}  // namespace ols
