#include "base/text/plain_text.h"

#include <glib.h>

namespace ols {

std::string plain_text(std::string_view text) {
  std::string plain;
  plain.reserve(text.size());
  while (!text.empty()) {
    const gunichar character =
        g_utf8_get_char_validated(text.data(), static_cast<gssize>(text.size()));
    const bool whole = character < 0x80000000U;  // else an error: damaged, or cut off
    const auto bytes = whole ? static_cast<std::size_t>(g_unichar_to_utf8(character, nullptr)) : 1U;
    if (whole && g_unichar_isprint(character)) {
      plain += text.substr(0, bytes);
    } else {
      plain += '?';
    }
    text.remove_prefix(bytes);
  }
  return plain;
}

}  // namespace ols
