// ols-logger: records the bus, under a quota or into one file. Parses, loads, wires and loops.
#include <poll.h>
#include <spdlog/spdlog.h>

#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "base/process/shutdown.h"
#include "base/process/status_file.h"
#include "conditions/printed.h"
#include "tools/logger/bus_recorder.h"
#include "tools/logger/supervisor.h"

namespace {

constexpr int kTurn_ms = 100;
constexpr double kStatus_s = 1.0;

std::string status_line(const ols::logger::LoggerStatus& status) {
  const std::string room = ols::printed("; %.1f GB in %zu files, %.1f GB free", status.bytes * 1e-9,
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
  // Ready even without a usable disk: it is retried, and the status reports it.
  ols::ServiceNotifier service_manager;
  supervisor.turn(ols::clock_monotonic_s());
  service_manager.ready(status_line(supervisor.status()));
  const auto turn = [&](double now_s) {
    supervisor.turn(now_s);
    ::poll(nullptr, 0, kTurn_ms);
  };
  serve(service_manager, kStatus_s, turn, [&] {
    const ols::logger::LoggerStatus status = supervisor.status();
    status_file.write(ols::logger::to_json(status, ols::clock_utime_us()));
    return status_line(status);
  });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Records the bus: the oldest files are removed when the quota is used up or the disk's free "
      "space falls below the reserve"};
  app.set_version_flag("--version", OLS_VERSION);
  ols::ServiceOptions options;
  std::string folder, output;
  add_service_options(app, options);
  app.add_option("--folder", folder, "Folder of the logs, in place of the configuration's");
  app.add_option("--output", output,
                 "Record into this one new file instead, without a quota, until ended");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-logger")) return *status;
  return ols::run_service("ols-logger", ols::InvalidArgument::kBadInput, [&] {
    auto config = configuration_of(options, ols::logger::load_logger_config);
    if (!folder.empty()) config.folder = folder;
    if (options.check_config) return 0;
    return ols::as_bad_input(
        [&] { return output.empty() ? run(config) : run_into(output, config); });
  });
}
