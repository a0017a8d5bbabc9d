#include "base/config/toml_text.h"

#include <toml++/toml.h>

#include <sstream>

namespace ols {

std::string toml_text(const std::string& text) {
  std::ostringstream out;
  out << toml::toml_formatter{toml::value<std::string>(text),
                              toml::format_flags::quote_dates_and_times};
  return out.str();
}

}  // namespace ols
