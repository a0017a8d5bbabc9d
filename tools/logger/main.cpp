// ols-logger: records the bus, under a quota or into one file. Parses, loads, wires and loops.
#include <poll.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>

#include "base/bus/lcm_url.h"
#include "base/config/toml_config.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/service_notifier.h"
#include "base/process/shutdown.h"
#include "base/process/status_file.h"
#include "tools/logger/bus_recorder.h"
#include "tools/logger/supervisor.h"

namespace {

constexpr int kTurn_ms = 100;
constexpr double kStatus_s = 1.0;

std::string status_line(const ols::logger::LoggerStatus& status) {
  char room[96];
  std::snprintf(room, sizeof room, "; %.1f GB in %zu files, %.1f GB free", status.bytes * 1e-9,
                status.files, status.free_bytes * 1e-9);
  return (status.recording ? "recording " : "NOT recording: ") + status.text + room +
         (status.bus_alarm.empty() ? "" : "; " + status.bus_alarm);
}

// Records into one file until the program is ended.
int run_into(const std::string& file, const ols::logger::LoggerConfig& config) {
  ols::logger::BusRecorder recorder(config, file);
  ols::ServiceNotifier service_manager;
  service_manager.ready("recording " + file);
  ols::write_to_journal(
      {.text = "ready: records " + config.lcm_url + " to " + file, .id = ols::event::kReady});
  while (!ols::shutdown_requested() && !recorder.report().ended) ::poll(nullptr, 0, kTurn_ms);
  service_manager.stopping();
  const ols::logger::RecorderReport report = recorder.report();
  spdlog::info("{} messages recorded, {} dropped", report.messages, report.dropped);
  if (!report.ended) return 0;
  spdlog::error("{}", *report.ended);
  return 1;
}

int run(const ols::logger::LoggerConfig& config) {
  ols::logger::Supervisor supervisor(config);
  ols::StatusFile status_file(config.status_file);
  ols::ServiceNotifier service_manager;
  double status_due_s = 0.0;
  bool ready = false;
  while (!ols::shutdown_requested()) {
    const double now_s = ols::clock_monotonic_s();
    supervisor.turn(now_s);
    if (now_s >= status_due_s) {
      const ols::logger::LoggerStatus status = supervisor.status();
      // Ready even without a usable disk: it is retried, and the status reports it.
      ready ? service_manager.status(status_line(status))
            : service_manager.ready(status_line(status));
      ready = true;
      status_file.write(ols::logger::to_json(status, ols::clock_utime_us()));
      status_due_s = now_s + kStatus_s;
    }
    service_manager.alive(now_s);
    ::poll(nullptr, 0, kTurn_ms);
  }
  service_manager.stopping();
  ols::write_to_journal({.text = "stops", .id = ols::event::kStops});
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Records the bus: the oldest files are removed when the quota is used up or the disk's free "
      "space falls below the reserve"};
  app.set_version_flag("--version", OLS_VERSION);
  std::string config_path, folder, lcm_url, output;
  bool check = false;
  app.add_option("--config", config_path, "Configuration file (TOML); all keys have defaults");
  app.add_option("--folder", folder, "Folder of the logs, in place of the configuration's");
  app.add_option("--output", output,
                 "Record into this one new file instead, without a quota, until ended");
  app.add_option("--lcm-url", lcm_url, "Bus, in place of the configuration's");
  app.add_flag("--check-config", check, "Only read and check the configuration");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-logger")) return *status;
  spdlog::set_default_logger(spdlog::stderr_color_mt("ols-logger"));
  ols::install_shutdown_handler();
  try {
    ols::logger::LoggerConfig config;
    if (!config_path.empty()) config = ols::logger::load_logger_config(config_path);
    if (!folder.empty()) config.folder = folder;
    if (!lcm_url.empty()) config.lcm_url = lcm_url;
    ols::parse_lcm_url(config.lcm_url);  // throws when it is malformed
    if (check) return 0;
    return output.empty() ? run(config) : run_into(output, config);
  } catch (const ols::ConfigError& error) {
    std::fprintf(stderr, "ols-logger: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::system_error& error) {
    std::fprintf(stderr, "ols-logger: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const ols::BusError& error) {
    std::fprintf(stderr, "ols-logger: %s\n", error.what());
    return 1;
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "ols-logger: --lcm-url: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::exception& error) {
    spdlog::critical("{}", error.what());
    return 1;
  }
}
