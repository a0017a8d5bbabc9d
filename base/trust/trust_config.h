// How a process signs and verifies: the [trust] section of each configuration file.
#pragma once

#include <string>

namespace ols::config {
struct Section;
}
namespace ols::trust {

// kDefault: as the environment variable OLS_TRUST says; without it, off.
enum class Mode { kDefault, kOff, kObserve, kRequire };

struct TrustConfig {
  Mode mode = Mode::kDefault;
  std::string key;   // empty: see key_path()
  std::string list;  // empty: see list_path()
  double clock_tolerance_s = 30.0;
};

config::Section trust_section(TrustConfig& config);

// From the environment, if the configuration does not state it. The environment's variables, and
// those of systemd, are passed in.
struct Environment {
  std::string mode{};         // OLS_TRUST
  std::string keys{};         // OLS_KEYS: a folder of NAME.key files, trust.toml, site.toml
  std::string credentials{};  // CREDENTIALS_DIRECTORY: of systemd
  std::string state{};        // STATE_DIRECTORY: of systemd
};
// Throws std::invalid_argument for another word in OLS_TRUST.
Mode mode_of(const TrustConfig& config, const Environment& environment);
// `name`: of the member.
std::string key_path(const TrustConfig& config, const Environment& environment,
                     const std::string& name);
std::string list_path(const TrustConfig& config, const Environment& environment);
// Of the site's settings: beside the list.
std::string settings_path(const TrustConfig& config, const Environment& environment);
// The file of what was received, for the next start; empty: none, without a folder of state.
std::string kept_path(const Environment& environment, const std::string& what,
                      const std::string& name);

}  // namespace ols::trust
