// ols-export: parses the command line, loads the configuration, wires the parts and loops.
#include <spdlog/spdlog.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/files/atomic_file.h"
#include "base/journal/journal.h"
#include "base/journal/trouble_log.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/progress.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "base/process/status_file.h"
#include "base/trust/bus_trust.h"
#include "export/conversion.h"
#include "export/export_bus.h"
#include "export/export_config.h"
#include "export/exporter.h"
#include "export/factory.h"
#include "export/protobuf_log.h"
#include "export/readiness.h"
#include "export/status.h"

namespace {

namespace exports = ols::exports;

constexpr int kTurn_ms = 20;
constexpr double kStatus_s = 1.0;

struct Arguments : ols::ServiceOptions {
  std::string format;
  exports::Conversion conversion;
  double rate_hz = 100.0;
  bool stations = true, lines = false, tentative = false;
};

exports::ExportConfig configuration(const Arguments& arguments) {
  exports::ExportConfig config = configuration_of(arguments, exports::load_export_config);
  const ols::trust::SiteSettings site = ols::trust::settings_at_start(
      config.trust, ols::trust::process_environment(), exports::kMemberName, {});
  if (!config.has_own_geoid && !site.geoid.empty()) config.geoid = site.geoid;
  return config;
}

exports::ExportStatus status_of(const exports::Exporter& exporter, const exports::ExportBus& bus) {
  exports::ExportStatus status;
  status.utime_us = ols::clock_utime_us();
  status.targets = exporter.targets();
  status.counters = exporter.counters();
  bus.count(status.counters);
  status.counters["protobuf_warnings"] = static_cast<double>(exports::protobuf_warnings());
  status.alarms = bus.all_alarms(ols::clock_monotonic_s());
  for (const auto& output : exporter.outputs()) {
    status.outputs.emplace_back(output->name(), output->report());
  }
  return status;
}

int run(const exports::ExportConfig& config) {
  exports::count_protobuf_warnings();
  const exports::SiteContext site = site_context(config, formats_of(config));
  std::vector<std::unique_ptr<exports::Output>> outputs;
  for (const exports::OutputConfig& output : config.outputs) {
    outputs.push_back(make_output(output, config));
  }
  if (outputs.empty()) spdlog::warn("no [[output]] is configured: nothing goes out");
  exports::Exporter exporter(site, std::move(outputs), config.max_age_s);
  exports::ExportBus bus(config.lcm_url, config.trust, [&](const ols::BusMessage& message) {
    exporter.receive(message, ols::clock_utime_us());
  });
  bus.connect(ols::clock_monotonic_s(), ols::BusConnector::kLongest_s);
  ols::ServiceNotifier service_manager;
  service_manager.ready("exports");
  ols::write_to_journal({.text = "ready: " + std::to_string(exporter.outputs().size()) + " outputs",
                         .id = ols::event::kReady});
  ols::TroubleLog troubles("output");
  ols::StatusFile status_file(config.status_file);
  const auto turn = [&](double now_s) {
    bus.turn(now_s, kTurn_ms);
    exporter.step(now_s, ols::clock_utime_us());
  };
  const auto report = [&] {
    const exports::ExportStatus status = status_of(exporter, bus);
    for (const auto& [name, output] : status.outputs) {
      troubles.look(name, output.trouble, ols::clock_monotonic_s());
    }
    status_file.write(to_json(status));
    return in_one_line(status);
  };
  serve(service_manager, kStatus_s, turn, report);
  return 0;
}

int convert(const Arguments& arguments, const exports::ExportConfig& config) {
  exports::GateConfig gate;
  gate.rate_hz = arguments.rate_hz;
  gate.stations = arguments.stations;
  gate.lines = arguments.lines;
  gate.tentative = arguments.tentative;
  try {
    const exports::ConversionReport report = exports::convert(
        arguments.conversion, config, gate, ols::Progress("ols-export", "bytes of the log"));
    std::fprintf(stderr, "ols-export: %zu positions, %zu places of stations, %zu lines\n",
                 report.targets, report.stations, report.lines);
    if (!report.damage.empty()) {
      std::fprintf(stderr, "ols-export: left out: %s\n", report.damage.c_str());
    }
    return 0;
  } catch (const std::exception& error) {
    throw std::invalid_argument(error.what());
  }
}

void add_conversion(CLI::App& app, Arguments& arguments) {
  auto* output = app.add_option("--output", arguments.conversion.output, "File to write");
  auto* format = app.add_option("--format", arguments.format,
                                "geojson, kml, gpx, courageous, or cot: events as XML");
  auto* log =
      app.add_option("--log", arguments.conversion.log,
                     "Write this recorded LCM log into a file, in place of serving the bus");
  auto* fixes = app.add_option("--fixes", arguments.conversion.fixes,
                               "Write these positions, the output of ols-fuse, into a file");
  log->needs(format)->needs(output)->excludes(fixes);
  fixes->needs(format)->needs(output);
  output->needs(format);
  app.add_option("--rate", arguments.rate_hz,
                 "[Hz] with --log or --fixes: maximum rate of each object")
      ->check(CLI::Range(0.01, 1000.0))
      ->capture_default_str();
  app.add_flag("--lines", arguments.lines, "with --log: also the stations' lines of sight");
  app.add_flag("--tentative", arguments.tentative, "with --log: also unconfirmed targets");
  app.add_flag("--skip-damage", arguments.conversion.skips_damage,
               "with --log: write what is left of a damaged or cut-off log");
  app.add_flag("!--no-stations", arguments.stations, "with --log: no stations");
}

int act(Arguments& arguments) {
  const exports::ExportConfig config = configuration(arguments);
  if (!arguments.format.empty()) {
    arguments.conversion.format = exports::format_from(arguments.format);
    if (arguments.conversion.log.empty() && arguments.conversion.fixes.empty()) {
      throw std::invalid_argument("--format: needs --log or --fixes");
    }
    ols::remove_temporary_files_on_signals();
    return convert(arguments, config);
  }
  check_files(config);
  if (!arguments.check_config) return run(config);
  static_cast<void>(site_context(config, formats_of(config)));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Targets and stations for others' programs: TAK, SAPIENT, ASTERIX, MQTT, GeoJSON, KML, GPX "
      "and "
      "more"};
  app.set_version_flag("--version", OLS_VERSION);
  Arguments arguments;
  add_service_options(app, arguments);
  add_conversion(app, arguments);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-export")) return *status;
  std::signal(SIGPIPE, SIG_IGN);  // a receiver that has gone is an error of its own connection
  return ols::run_service("ols-export", ols::InvalidArgument::kBadInput,
                          [&arguments] { return act(arguments); });
}
