// How a process signs and verifies: the [trust] section of each configuration file.
#pragma once

#include <string>

namespace ols::config {
struct Section;
}
namespace ols::trust {

// kDefault: the mode that the environment variable OLS_TRUST names; off if there is no such
// variable.
enum class Mode { kDefault, kOff, kObserve, kRequire };

struct TrustConfig {
  Mode mode = Mode::kDefault;
  std::string key;   // empty: see key_path()
  std::string list;  // empty: see list_path()
  double clock_tolerance_s = 30.0;
};

config::Section trust_section(TrustConfig& config);

// Environment variables, from OLS and from systemd, with values for whatever the configuration
// leaves open.
struct Environment {
  std::string mode{};         // OLS_TRUST
  std::string keys{};         // OLS_KEYS: a folder of NAME.key files, trust.toml, site.toml
  std::string credentials{};  // CREDENTIALS_DIRECTORY, from systemd
  std::string state{};        // STATE_DIRECTORY, from systemd
};
// Throws std::invalid_argument for an unknown word in OLS_TRUST.
Mode mode_of(const TrustConfig& config, const Environment& environment);
// `name`: the member's name.
std::string key_path(const TrustConfig& config, const Environment& environment,
                     const std::string& name);
std::string list_path(const TrustConfig& config, const Environment& environment);
// The path of the site's settings, beside the list.
std::string settings_path(const TrustConfig& config, const Environment& environment);
// The path of the file in which a process keeps received data for its next start. `what`: the kind
// of data; `name`: the process. Empty: there is no state folder.
std::string kept_path(const Environment& environment, const std::string& what,
                      const std::string& name);

}  // namespace ols::trust
