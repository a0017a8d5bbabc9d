// The frame of a program that runs until it is asked to end: common options, exit status, and a
// loop that serves the service manager's watchdog.
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

// What std::invalid_argument means in a program: bad input, or a failure of the program.
enum class InvalidArgument { kBadInput, kFailure };

// Runs `act`, and logs under the program's name. Returns the exit status of `act`; 1 after a
// failure; 2 after bad input, which is logged in one line. The service manager does not restart a
// program after bad input, because that would not help.
int run_service(const std::string& program, InvalidArgument invalid,
                const std::function<int()>& act);

// Runs the action. If the action cannot read or write a file, this counts as bad input, because a
// restart would not help.
template <class Action>
auto as_bad_input(Action action) {
  try {
    return action();
  } catch (const std::system_error& error) {
    throw std::invalid_argument(error.what());
  }
}

// Calls `turn` again and again until the process is asked to end, and `status` every status_s. The
// service manager shows the line that `status` returns. Times are monotonic.
void serve(ServiceNotifier& service_manager, double status_s,
           const std::function<void(double now_s)>& turn,
           const std::function<std::string()>& status);

}  // namespace ols
