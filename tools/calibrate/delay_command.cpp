#include "tools/calibrate/delay_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "tools/calibrate/bearing_log.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/config_change.h"

namespace ols::calibration {
namespace {

// The keys of a configuration that hold a delay of the pictures, and their defaults.
struct DelayKeys {
  std::string value, sd;
  double default_s;
};

std::string text_of(const setup::Values& values, const std::string& key) {
  const std::string* value = setup::find(values, key);
  return value == nullptr ? "" : setup::text_in(*value).value_or("");
}

// A picture's time is its arrival minus delay_s, or the time of a sender report minus
// report_delay_s.
DelayKeys keys_of(const setup::Values& config, bool by_arrival) {
  const std::string kind = text_of(config, "camera.kind");
  if (kind == "v4l2") return {"camera.delay_s", "camera.delay_sd_s", 0.02};
  if (kind != "rtsp")
    throw std::invalid_argument("[camera] is not of the kind \"rtsp\" or \"v4l2\"");
  if (by_arrival) return {"camera.delay_s", "camera.delay_sd_s", 0.3};
  return {"camera.report_delay_s", "camera.report_sd_s", 0.0};
}

std::size_t index_of(const BearingLog& log, const std::string& station) {
  const auto found = std::ranges::find(log.stations, station);
  if (found == log.stations.end())
    throw std::runtime_error("--recording: no bearings of station '" + station + "'");
  return static_cast<std::size_t>(found - log.stations.begin());
}

bool is_by_arrival(const BearingLog& log, std::size_t station) {
  const auto all =
      static_cast<std::size_t>(std::ranges::count(log.bearings, station, &TimedBearing::station));
  const std::size_t by_arrival = log.by_arrival[station];
  if (by_arrival != 0 && by_arrival != all)
    throw std::runtime_error(fmt::format(
        "--recording: {} of {} times are by arrivals, the others by sender reports, which have "
        "another delay: use a recording with one kind",
        by_arrival, all));
  return by_arrival != 0;
}

std::runtime_error no_delay(const DelayFit& fit) {
  return std::runtime_error(fmt::format(
      "no delay found: at {} seconds, the station and another one saw one object ({} left out: "
      "several objects). Needed are at least 10, and an object that moves fast, to and fro",
      fit.seconds, fit.several));
}

CommandReport report_on(const BearingLog& log, const DelayFit& fit, const std::string& station) {
  CommandReport report{{}, {}, log.damage};
  report.summary.push_back(fmt::format(
      "{}: pictures are stamped {:.1f} +- {:.1f} ms too {}, by {} seconds; the lines miss each "
      "other by {:.1f} times what is expected",
      station, 1e3 * std::abs(fit.late_s->value), 1e3 * fit.late_s->sd,
      fit.late_s->value < 0.0 ? "early" : "late", fit.seconds, fit.misfit));
  if (fit.several > 0)
    report.notes.push_back(fmt::format("{} seconds with several objects: left out", fit.several));
  if (log.unsynchronised > 0)
    report.notes.push_back(fmt::format(
        "{} bearings of stations that did not know the time: left out", log.unsynchronised));
  if (log.unusable > 0)
    report.faults.push_back(fmt::format("{} bearings cannot be read: left out", log.unusable));
  return report;
}

}  // namespace

CLI::App* add_delay(CLI::App& app, DelayOptions& o) {
  CLI::App* delay = app.add_subcommand(
      "delay",
      "The constant delay of a camera's pictures, out of recordings in which other stations saw "
      "the same object. One object that moves fast, to and fro, for a minute or more.");
  delay
      ->add_option("--station", o.station,
                   "its configuration, or its name: NAME is /etc/ols/NAME.toml")
      ->required();
  delay->add_option("--recording", o.recordings, "log of the bus, as ols-logger writes it; several")
      ->required();
  delay->add_flag("--write", o.write, "change [camera] of the station's configuration");
  return delay;
}

int run_delay(const DelayOptions& o) {
  constexpr double kLeastSd_s = 1e-4;  // of a configuration
  const std::string path = config_path(o.station), text = config_text(path);
  const setup::Values before = setup::flat(text);
  const std::string station = text_of(before, "id");
  const BearingLog log = read_bearings(o.recordings);
  const std::size_t wanted = index_of(log, station);
  const DelayKeys keys = keys_of(before, is_by_arrival(log, wanted));
  const DelayFit fit = fit_delay(log.bearings, log.errors, wanted);
  if (!fit.late_s) throw no_delay(fit);
  const int status = tell(report_on(log, fit, station));
  setup::Values now = before;
  const double delay_s = number_in(before, keys.value, keys.default_s) + fit.late_s->value;
  if (delay_s < 0.0 && keys.value == "camera.delay_s")
    throw std::runtime_error(fmt::format(
        "{} would be {:.3f} s: pictures cannot arrive before their exposure. Are the clocks of "
        "all stations right?",
        keys.value, delay_s));
  set(now, keys.value, delay_s);
  set(now, keys.sd, std::max(fit.late_s->sd, kLeastSd_s));
  tell_changes(before, now);
  if (o.write) write_changes(path, text, before, now);
  return status;
}

}  // namespace ols::calibration
