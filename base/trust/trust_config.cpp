#include "base/trust/trust_config.h"

#include <stdexcept>

#include "base/config/config_section.h"

namespace ols::trust {
namespace {

const config::Words<Mode> kModes{{"default", Mode::kDefault},
                                 {"off", Mode::kOff},
                                 {"observe", Mode::kObserve},
                                 {"require", Mode::kRequire}};

}  // namespace

config::Section trust_section(TrustConfig& c) {
  return {"trust",
          "Signatures on the bus (docs/security.md).",
          {config::word("mode", c.mode, kModes,
                        "off; observe: signs, and counts unsigned messages; require: accepts only "
                        "messages that a member of the site has signed. default: as the "
                        "environment variable OLS_TRUST says, or off."),
           config::text("key", c.key, "File of this process's private key.")
               .default_is("the credential ols-key of its unit, NAME.key in OLS_KEYS, or "
                           "/etc/credstore/ols-NAME.key"),
           config::text("list", c.list, "File of the site's trust list.")
               .default_is("trust.toml in OLS_KEYS, or /etc/ols/trust.toml"),
           config::number("clock_tolerance_s", c.clock_tolerance_s, {1.0, 3600.0}, "s",
                          "Messages stamped further from this host's clock are refused: they are "
                          "recordings.")}};
}

Mode mode_of(const TrustConfig& config, const Environment& environment) {
  if (config.mode != Mode::kDefault) return config.mode;
  if (environment.mode.empty()) return Mode::kOff;
  for (const auto& [word, mode] : kModes) {
    if (environment.mode == word && mode != Mode::kDefault) return mode;
  }
  throw std::invalid_argument("OLS_TRUST: \"" + environment.mode +
                              "\" is not off, observe or require");
}

std::string key_path(const TrustConfig& config, const Environment& environment,
                     const std::string& name) {
  if (!config.key.empty()) return config.key;
  if (!environment.credentials.empty()) return environment.credentials + "/ols-key";
  if (!environment.keys.empty()) return environment.keys + "/" + name + ".key";
  return "/etc/credstore/ols-" + name + ".key";
}

std::string list_path(const TrustConfig& config, const Environment& environment) {
  if (!config.list.empty()) return config.list;
  if (!environment.keys.empty()) return environment.keys + "/trust.toml";
  return "/etc/ols/trust.toml";
}

std::string settings_path(const TrustConfig& config, const Environment& environment) {
  const std::string list = list_path(config, environment);
  return list.substr(0, list.rfind('/') + 1) + "site.toml";
}

std::string kept_path(const Environment& environment, const std::string& what,
                      const std::string& name) {
  return environment.state.empty() ? "" : environment.state + "/" + what + "-" + name + ".toml";
}

}  // namespace ols::trust
