// The frame of a program that runs until it is asked to end: its common options, its exit status,
// and its loop with the service manager's watchdog.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <system_error>

#include "base/process/service_notifier.h"

namespace ols {

struct ServiceOptions {
  std::string config, lcm_url;
  bool check_config = false;
};

void add_service_options(CLI::App& app, ServiceOptions& options);

// The configuration from the file and the options. `load` throws ConfigError.
template <class Config>
Config configuration_of(const ServiceOptions& options, Config (*load)(const std::string& path)) {
  Config config;
  if (!options.config.empty()) config = load(options.config);
  if (!options.lcm_url.empty()) config.lcm_url = options.lcm_url;
  return config;
}

// Whether std::invalid_argument means bad input of the caller or a failure of the program.
enum class InvalidArgument { kBadInput, kFailure };

// Runs `act`, and logs under the program's name. Returns act's exit status; 1 after a failure; 2
// after bad input, which is logged in one line (a restart would not help).
int run_service(const std::string& program, InvalidArgument invalid,
                const std::function<int()>& act);

// Runs the action; its failure to read or write a file counts as bad input, because a restart does
// not help against it.
template <class Action>
auto as_bad_input(Action action) {
  try {
    return action();
  } catch (const std::system_error& error) {
    throw std::invalid_argument(error.what());
  }
}

// Calls `turn` until the process is asked to end, and `status` every status_s. The service manager
// shows the line that `status` returns. Times are monotonic.
void serve(ServiceNotifier& service_manager, double status_s,
           const std::function<void(double now_s)>& turn,
           const std::function<std::string()>& status);

}  // namespace ols
