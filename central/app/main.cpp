// ols-fusion: parses the command line, loads the configuration, wires the parts and loops.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>

#include "base/boot_id.h"
#include "base/clocks.h"
#include "base/command_line.h"
#include "base/lcm_url.h"
#include "base/service_notifier.h"
#include "base/shutdown.h"
#include "base/toml_config.h"
#include "central/app/fusion_process.h"

namespace {

// Group and port differ from those of any site's bus.
constexpr const char* kReplaySlewUrl = "udpm://239.255.76.68:7668?ttl=0";

struct Arguments {
  std::string config;
  std::string lcm_url;
  std::string slew_url;
  bool replay = false;
  bool check_config = false;
};

// What is wrong with the URL, for the command line; empty: nothing.
std::string url_problem(const std::string& url) {
  try {
    ols::parse_lcm_url(url);
    return "";
  } catch (const std::invalid_argument& problem) {
    return problem.what();
  }
}

int run(const Arguments& arguments) {
  ols::fusion::FusionSettings settings;
  if (!arguments.config.empty()) settings = ols::fusion::load_fusion_settings(arguments.config);
  if (!arguments.lcm_url.empty()) settings.lcm_url = arguments.lcm_url;
  if (arguments.check_config) return 0;
  ols::fusion::FusionProcessOptions options{
      .slew_url = arguments.replay ? kReplaySlewUrl : settings.lcm_url,
      .replay = arguments.replay,
      .boot_id = ols::draw_boot_id()};
  if (!arguments.slew_url.empty()) options.slew_url = arguments.slew_url;
  ols::fusion::FusionProcess process(settings, options);
  spdlog::info("ready: bus {}, slews to {}", settings.lcm_url, options.slew_url);
  ols::ServiceNotifier service_manager;
  service_manager.ready("bus " + settings.lcm_url);
  double status_due_s = 0.0;
  while (!ols::shutdown_requested()) {
    process.turn();
    const double now_s = ols::clock_monotonic_s();
    service_manager.alive(now_s);
    if (now_s >= status_due_s) {
      status_due_s = now_s + settings.status_interval_s;
      service_manager.status(process.in_one_line());
    }
  }
  service_manager.stopping();
  spdlog::info("stops");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Fusion of the stations' bearings: targets and slew commands over LCM"};
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  app.add_option("--config", arguments.config, "Configuration file (TOML); all keys have defaults");
  app.add_option("--lcm-url", arguments.lcm_url, "Bus, in place of the configuration's")
      ->check(url_problem);
  app.add_flag("--replay", arguments.replay,
               "The messages are recorded ones: their time is not the present, and slews go to a "
               "bus of their own, so that no real PTU moves");
  app.add_option(
         "--slew-url", arguments.slew_url,
         std::string("Bus for slews; default: the same, or with --replay ") + kReplaySlewUrl)
      ->check(url_problem);
  app.add_flag("--check-config", arguments.check_config, "Only read and check the configuration");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-fusion")) return *status;
  spdlog::set_default_logger(spdlog::stderr_color_mt("ols-fusion"));
  ols::install_shutdown_handler();
  try {
    return run(arguments);
  } catch (const ols::ConfigError& error) {
    std::fprintf(stderr, "ols-fusion: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
    return 1;
  }
}
