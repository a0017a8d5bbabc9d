#include "base/process/service_frame.h"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <stdexcept>

#include "base/bus/lcm_url.h"
#include "base/config/toml_config.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"

namespace ols {
namespace {

int say_bad_input(const std::string& program, const std::exception& error) {
  std::fprintf(stderr, "%s: %s\n", program.c_str(), error.what());
  return kExitBadInput;
}

}  // namespace

void add_service_options(CLI::App& app, ServiceOptions& options) {
  app.add_option("--config", options.config, "Configuration file (TOML); all keys have defaults");
  app.add_option("--lcm-url", options.lcm_url, "Bus, in place of the configuration's")
      ->check(lcm_url_problem);
  app.add_flag("--check-config", options.check_config, "Only read and check the configuration");
}

int run_service(const std::string& program, InvalidArgument invalid,
                const std::function<int()>& act) {
  spdlog::set_default_logger(spdlog::stderr_color_mt(program));
  install_shutdown_handler();
  try {
    return act();
  } catch (const ConfigError& error) {
    return say_bad_input(program, error);
  } catch (const std::invalid_argument& error) {
    if (invalid == InvalidArgument::kBadInput) return say_bad_input(program, error);
    spdlog::critical("{}", error.what());
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
  }
  return 1;
}

void serve(ServiceNotifier& service_manager, double status_s,
           const std::function<void(double now_s)>& turn,
           const std::function<std::string()>& status) {
  double status_due_s = 0.0;
  while (!shutdown_requested()) {
    const double now_s = clock_monotonic_s();
    turn(now_s);
    service_manager.alive(now_s);
    if (now_s < status_due_s) continue;
    status_due_s = now_s + status_s;
    service_manager.status(status());
  }
  service_manager.stopping();
  write_to_journal({.text = "stops", .id = event::kStops});
}

}  // namespace ols
