// The frame of a program that runs until it is asked to end: its common options, its exit status,
// and its loop with the service manager's watchdog.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "base/service_notifier.h"

namespace ols {

struct ServiceOptions {
  std::string config, lcm_url;
  bool check_config = false;
};

void add_service_options(CLI::App& app, ServiceOptions& options);

// The configuration as its file and the options say. `load` throws ConfigError.
template <class Config>
Config configuration_of(const ServiceOptions& options, Config (*load)(const std::string& path)) {
  Config config;
  if (!options.config.empty()) config = load(options.config);
  if (!options.lcm_url.empty()) config.lcm_url = options.lcm_url;
  return config;
}

// Whose fault an std::invalid_argument is: of who called the program, or of its own.
enum class InvalidArgument { kBadInput, kFailure };

// Runs `act` and logs by the program's name. The exit status: act's; 2 after bad input, which no
// restart helps, with one line that says what; 1 after a failure.
int run_service(const std::string& program, InvalidArgument invalid,
                const std::function<int()>& act);

// Calls `turn` until the process is asked to end, and each status_s `status`, whose line the
// service manager shows. Times: monotonic.
void serve(ServiceNotifier& service_manager, double status_s,
           const std::function<void(double now_s)>& turn,
           const std::function<std::string()>& status);

}  // namespace ols
