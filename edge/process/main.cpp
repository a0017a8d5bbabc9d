// ols-station: one tripod. Parses, loads, wires and loops.
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <opencv2/core/utility.hpp>
#include <string>

#include "base/bus/boot_id.h"
#include "base/config/toml_config.h"
#include "base/files/csv_files.h"
#include "base/journal/journal.h"
#include "base/process/command_line.h"
#include "base/process/shutdown.h"
#include "base/trust/bus_trust.h"
#include "edge/calibration/calibration_folder.h"
#include "edge/command/rearm_signal.h"
#include "edge/messages/messages_bus.h"
#include "edge/process/station_process.h"
#include "geometry/angles.h"
#include "land/terrain_folder.h"

namespace {

using ols::station::StationSettings;

StationSettings load(const std::string& config, const ols::trust::SiteSettings& site) {
  StationSettings settings = ols::station::load_station_settings(config, site);
  // systemd's StateDirectory=.
  const char* folder = std::getenv("STATE_DIRECTORY");
  if (settings.state_folder.empty() && folder != nullptr) settings.state_folder = folder;
  settings.software = OLS_VERSION;
  return settings;
}

void say_site(const StationSettings& settings) {
  if (settings.site.number == 0) return;
  std::string own;
  for (const std::string& key : settings.site.own) own += (own.empty() ? "" : ", ") + key;
  ols::write_to_journal(
      {.text = fmt::format("site settings {} in use{}{}", settings.site.number,
                           own.empty() ? "" : "; this station's file says otherwise for ", own),
       .id = ols::event::kSiteSettings,
       .station = settings.id});
}

// A running station goes on without the calibration or the land that it cannot read.
void check_folders(const StationSettings& settings) {
  if (!settings.calibration_folder.empty()) {
    const auto files = ols::station::read_calibration(settings.calibration_folder, settings);
    std::printf("ok calibration: %lld, 1-sigma %.1f arc seconds\n",
                static_cast<long long>(files.id), files.rms_rad * 648000.0 / ols::kPi);
  }
  if (!settings.land_folder.empty()) {
    const auto land = ols::land::check_configured_land(settings.land_folder);
    std::printf("ok land: %.0f km around %.4f, %.4f\n", land.radius_km, land.latitude_deg,
                land.longitude_deg);
  }
}

int run(const std::string& config, const StationSettings& own) {
  cv::setNumThreads(1);  // a frame is small; the other core is for the camera's stream
  const StationSettings settings =
      load(config, ols::trust::settings_at_start(own.trust, trust_environment(own), own.id,
                                                 ols::station::site_check(config)));
  ols::station::StationProcess process(settings, ols::draw_boot_id());
  ols::write_to_journal(
      {.text = fmt::format("station {} ready: camera {}, PTU {}, bus {}", settings.id,
                           settings.camera->address(), settings.mount->words(), settings.lcm_url),
       .id = ols::event::kReady,
       .station = settings.id});
  say_site(settings);
  process.run(ols::shutdown_requested);
  ols::write_to_journal(
      {.text = "station " + own.id + " stops", .id = ols::event::kStops, .station = own.id});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"One camera station: captures, tracks, servoes and sends bearings over LCM"};
  app.set_version_flag("--version", OLS_VERSION);
  std::string config;
  bool check = false;
  app.add_option("--config", config, "Configuration file (TOML)")->required();
  app.add_flag("--check-config", check, "Only read and check the configuration");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-station")) return *status;
  spdlog::set_default_logger(spdlog::stderr_color_mt("ols-station"));
  ols::install_shutdown_handler();
  ols::station::install_rearm_handler();
  try {
    const StationSettings settings = load(config, {});
    if (check) {
      for (const auto& line : describe(settings)) std::printf("ok %s\n", line.c_str());
      check_folders(settings);
      ols::flush_output();
      return 0;
    }
    return run(config, settings);
  } catch (const ols::ConfigError& error) {
    std::fprintf(stderr, "ols-station: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const ols::CsvError& error) {
    std::fprintf(stderr, "ols-station: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "ols-station: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
    return 1;
  }
}
