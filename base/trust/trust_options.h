// Command line options in place of the [trust] section, for programs without a configuration file.
#pragma once

#include <unistd.h>

#include <map>
#include <string>

#include "base/process/command_line.h"
#include "base/trust/bus_trust.h"

namespace ols::trust {

// If there is a key, the program signs its orders by default: a site that requires signatures obeys
// only signed orders, and any other site ignores the signature.
inline void add_trust_options(CLI::App& app, TrustConfig& config) {
  const std::map<std::string, Mode> modes{
      {"off", Mode::kOff}, {"observe", Mode::kObserve}, {"require", Mode::kRequire}};
  const bool is_free = process_environment().mode.empty();
  if (is_free && ::access(key_path(config, {}, "operator").c_str(), R_OK) == 0) {
    config.mode = Mode::kRequire;
  }
  app.add_option("--trust", config.mode,
                 "Signatures on the bus: off, observe or require; else as OLS_TRUST says; else "
                 "require where there is a key, off where there is none")
      ->transform(CLI::CheckedTransformer(modes).description(""));
  app.add_option("--key", config.key,
                 "File of the private key to sign with; else operator.key in OLS_KEYS, or "
                 "/etc/credstore/ols-operator.key")
      ->each([&config, is_free](const std::string&) {
        if (is_free && config.mode == Mode::kDefault) config.mode = Mode::kRequire;
      });
  app.add_option("--trust-list", config.list,
                 "File of the site's trust list; else trust.toml in OLS_KEYS, or in /etc/ols");
}

}  // namespace ols::trust
