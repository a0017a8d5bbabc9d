// ols-cue: parses the command line, loads the configuration, wires the parts and loops.
#include <spdlog/spdlog.h>

#include <boost/asio/io_context.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/journal/journal.h"
#include "base/journal/trouble_log.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "base/process/status_file.h"
#include "cue/cue_bus.h"
#include "cue/cue_config.h"
#include "cue/inlet/inlet.h"
#include "cue/input_reader.h"
#include "cue/live_cues.h"
#include "cue/source.h"
#include "cue/status.h"
#include "export/protobuf_log.h"
#include "land/geoid.h"

namespace {

namespace cues = ols::cues;

constexpr int kTurn_ms = 20;
constexpr double kReading_s = 0.02;  // longest in a turn: a flood must not hold up the loop
constexpr double kStatus_s = 1.0;
constexpr double kSend_s = 0.2;  // the fusion ends a cue that has been silent for two seconds

// Without a grid, only reports with heights above the geoid are refused.
cues::GeoidHeight geoid_of(const cues::CueConfig& config) {
  try {
    return [geoid = std::make_shared<const ols::land::Geoid>(config.geoid)](double latitude_deg,
                                                                            double longitude_deg) {
      return geoid->height_m(latitude_deg, longitude_deg);
    };
  } catch (const std::invalid_argument& missing) {
    spdlog::warn("geoid {}", missing.what());
    return {};
  }
}

class Inputs {
 public:
  Inputs(const cues::CueConfig& config, cues::LiveCues& cues) : cues_(cues) {
    for (const cues::InputConfig& input : config.inputs) {
      const cues::Source source = cues::parse_source(input.from);
      names_.push_back(input.rules.name);
      readers_.push_back(std::make_unique<cues::InputReader>(
          input.format, input.types, source.carrier == cues::Carrier::kTcp,
          input.format == cues::Format::kSapient ? geoid_of(config) : cues::GeoidHeight{}));
      inlets_.push_back(make_inlet(context_, source, input.poll_s, sink(readers_.size() - 1)));
    }
  }

  void turn() {
    context_.restart();
    const double end_s = ols::clock_monotonic_s() + kReading_s;
    while (context_.poll_one() > 0 && ols::clock_monotonic_s() < end_s) continue;
  }

  std::vector<cues::InputStatus> status() const {
    std::vector<cues::InputStatus> all;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const cues::InletReport& report = inlets_[i]->report();
      all.push_back({names_[i], report.is_open, report.trouble, report.openings, report.failures,
                     report.bytes, cues_.counts()[i]});
    }
    return all;
  }

 private:
  cues::InletSink sink(std::size_t input) {
    return {[this, input] { readers_[input]->clear(); },
            [this, input](std::string_view bytes) {
              const std::int64_t now_us = ols::clock_utime_us();
              cues_.take(input, readers_[input]->take(bytes, now_us), now_us);
            }};
  }

  cues::LiveCues& cues_;
  boost::asio::io_context context_;
  std::vector<std::string> names_;
  std::vector<std::unique_ptr<cues::InputReader>> readers_;
  std::vector<std::unique_ptr<cues::Inlet>> inlets_;
};

std::vector<cues::InputRules> rules_of(const cues::CueConfig& config) {
  std::vector<cues::InputRules> rules;
  for (const cues::InputConfig& input : config.inputs) rules.push_back(input.rules);
  return rules;
}

cues::CueStatus status_of(const Inputs& inputs, const cues::CueBus& bus, std::size_t live) {
  cues::CueStatus status;
  status.utime_us = ols::clock_utime_us();
  status.cues = live;
  bus.count(status.counters);
  status.counters["protobuf_warnings"] = static_cast<double>(ols::exports::protobuf_warnings());
  status.alarms = bus.all_alarms(ols::clock_monotonic_s());
  status.inputs = inputs.status();
  return status;
}

int run(const cues::CueConfig& config) {
  if (config.inputs.empty()) spdlog::warn("no [[input]] is configured: nothing comes in");
  ols::exports::count_protobuf_warnings();
  cues::LiveCues cues(rules_of(config), config.most);
  cues::CueBus bus(config.lcm_url, config.trust);
  bus.connect(ols::clock_monotonic_s(), ols::BusConnector::kLongest_s);
  Inputs inputs(config, cues);
  ols::ServiceNotifier service_manager;
  service_manager.ready("cues");
  ols::write_to_journal({.text = "ready: " + std::to_string(config.inputs.size()) + " inputs",
                         .id = ols::event::kReady});
  ols::TroubleLog troubles("input");
  ols::StatusFile status_file(config.status_file);
  double send_due_s = 0.0;
  const auto turn = [&](double now_s) {
    bus.turn(now_s, kTurn_ms);
    inputs.turn();
    if (now_s < send_due_s) return;
    send_due_s = now_s + kSend_s;
    bus.send(cues.live(ols::clock_utime_us()), ols::clock_utime_us());
  };
  const auto report = [&] {
    const cues::CueStatus status = status_of(inputs, bus, cues.live(ols::clock_utime_us()).size());
    for (const cues::InputStatus& input : status.inputs) {
      troubles.look(input.name, input.trouble, ols::clock_monotonic_s());
    }
    status_file.write(to_json(status));
    return in_one_line(status);
  };
  serve(service_manager, kStatus_s, turn, report);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Cues from outside for the fusion: TAK, SAPIENT, ADS-B, or lines of JSON"};
  app.set_version_flag("--version", OLS_VERSION);
  ols::ServiceOptions options;
  add_service_options(app, options);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-cue")) return *status;
  return ols::run_service("ols-cue", ols::InvalidArgument::kFailure, [&options] {
    const cues::CueConfig config = configuration_of(options, cues::load_cue_config);
    return options.check_config ? 0 : run(config);
  });
}
