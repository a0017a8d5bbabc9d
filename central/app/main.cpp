// ols-fusion: parses the command line, loads the configuration, wires the parts and loops.
#include <string>

#include "base/bus/boot_id.h"
#include "base/bus/lcm_url.h"
#include "base/journal/journal.h"
#include "base/process/command_line.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "central/app/fusion_process.h"
#include "land/terrain_folder.h"

namespace {

// Group and port differ from those of any site's bus.
constexpr const char* kReplaySlewUrl = "udpm://239.255.76.68:7668?ttl=0";

struct Arguments : ols::ServiceOptions {
  std::string slew_url;
  bool replay = false;
};

int run(const Arguments& arguments) {
  ols::fusion::FusionSettings settings =
      configuration_of(arguments, ols::fusion::load_fusion_settings);
  settings.fusion.land.surface = ols::land::read_configured_land(settings.land_folder).terrain;
  if (arguments.check_config) return 0;
  ols::fusion::FusionProcessOptions options{
      .slew_url = arguments.replay ? kReplaySlewUrl : settings.lcm_url,
      .replay = arguments.replay,
      .boot_id = ols::draw_boot_id()};
  if (!arguments.slew_url.empty()) options.slew_url = arguments.slew_url;
  ols::fusion::FusionProcess process(settings, options);
  ols::write_to_journal(
      {.text = "ready: bus " + settings.lcm_url + ", slews to " + options.slew_url,
       .id = ols::event::kReady});
  ols::ServiceNotifier service_manager;
  service_manager.ready("bus " + settings.lcm_url);
  serve(
      service_manager, settings.status_interval_s, [&process](double) { process.turn(); },
      [&process] { return process.in_one_line(); });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Fusion of the stations' bearings: targets and slew commands over LCM"};
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  add_service_options(app, arguments);
  app.add_flag("--replay", arguments.replay,
               "Take recorded messages, whose time is not the present; slews go to a bus of their "
               "own, so that no real PTU moves");
  app.add_option(
         "--slew-url", arguments.slew_url,
         std::string("Bus for slews; default: the same, or with --replay ") + kReplaySlewUrl)
      ->check(ols::lcm_url_problem);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-fusion")) return *status;
  return ols::run_service("ols-fusion", ols::InvalidArgument::kFailure,
                          [&arguments] { return run(arguments); });
}
