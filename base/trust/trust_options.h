// The command line's counterpart of the [trust] section, for programs without a configuration file.
#pragma once

#include <map>
#include <string>

#include "base/command_line.h"
#include "base/trust/trust_config.h"

namespace ols::trust {

inline void add_trust_options(CLI::App& app, TrustConfig& config) {
  const std::map<std::string, Mode> modes{
      {"off", Mode::kOff}, {"observe", Mode::kObserve}, {"require", Mode::kRequire}};
  app.add_option("--trust", config.mode,
                 "Signatures on the bus: off, observe or require; else as OLS_TRUST says, or off")
      ->transform(CLI::CheckedTransformer(modes).description(""));
  app.add_option("--key", config.key,
                 "File of the private key to sign with; else operator.key in OLS_KEYS, or "
                 "/etc/credstore/ols-operator.key");
  app.add_option("--trust-list", config.list,
                 "File of the site's trust list; else trust.toml in OLS_KEYS, or in /etc/ols");
}

}  // namespace ols::trust
