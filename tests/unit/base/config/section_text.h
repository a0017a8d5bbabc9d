// Reads one section of a configuration from text, for tests of what the section accepts and
// refuses.
#pragma once

#include <string>

#include "base/config/config_section.h"
#include "tests/unit/error_text.h"

namespace ols::test {

template <typename Config>
struct SectionText {
  std::string name;
  config::Section (*section)(Config&);

  Config read(const std::string& text) const {
    ConfigFile file(text.empty() ? "" : "[" + name + "]\n" + text, "station.toml");
    Config config;
    config::read(section(config), file.root().table(name));
    return config;
  }
  std::string error_of(const std::string& text) const {
    return error_text<ConfigError>([&] { static_cast<void>(read(text)); }, "accepted");
  }
};

}  // namespace ols::test
