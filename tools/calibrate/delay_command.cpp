#include "tools/calibrate/delay_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "base/config/toml_config.h"
#include "edge/camera/rtsp/rtsp_kind.h"
#include "edge/camera/v4l2/v4l2_kind.h"
#include "edge/config/config.h"
#include "tools/calibrate/bearing_log.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/config_change.h"
#include "tools/calibrate/light_recording.h"

namespace ols::calibration {
namespace {

// The keys in [camera] that hold a delay of the pictures, and the delay that the station uses.
struct DelayKeys {
  std::string value, sd;
  double delay_s;
};

// A picture's time is its arrival minus delay_s, or the time of a sender report minus
// report_delay_s.
DelayKeys keys_of(const station::ChosenCamera& camera, bool by_arrival) {
  if (const auto* v4l2 = camera.as<camera::V4l2Kind>())
    return {"delay_s", "delay_sd_s", v4l2->v4l2.delay_s};
  const auto* rtsp = camera.as<camera::RtspKind>();
  if (rtsp == nullptr)
    throw std::invalid_argument("[camera] is not of the kind \"rtsp\" or \"v4l2\"");
  if (by_arrival) return {"delay_s", "delay_sd_s", rtsp->rtsp.clock.delay_s};
  return {"report_delay_s", "report_sd_s", rtsp->rtsp.clock.report_delay_s};
}

// Throws if the station would refuse this delay.
void check_range(const station::ChosenCamera& camera, const std::string& key, double delay_s) {
  const std::vector<config::Row> rows = camera->section().rows;
  const auto row = std::ranges::find(rows, key, &config::Row::key);
  try {
    row->read(ConfigFile(fmt::format("{} = {:.6f}", key, delay_s), key).root());
  } catch (const ConfigError&) {
    throw std::runtime_error(fmt::format(
        "camera.{} would be {:.3f} s, but must be within {} s. Are the clocks of all stations "
        "right?",
        key, delay_s, row->values));
  }
}

// What was left out of the recordings.
std::vector<std::string> faults_of(const BearingLog& log) {
  std::vector<std::string> faults;
  if (log.unusable > 0)
    faults.push_back(fmt::format("{} bearings cannot be read: left out", log.unusable));
  return faults;
}

std::vector<std::string> notes_of(const BearingLog& log) {
  std::vector<std::string> notes;
  if (log.unsynchronised > 0)
    notes.push_back(fmt::format("{} bearings of stations that did not know the time: left out",
                                log.unsynchronised));
  if (log.disbelieved > 0)
    notes.push_back(
        fmt::format("{} bearings were hardly believed by the tracker: left out", log.disbelieved));
  return notes;
}

std::runtime_error failure(std::string why, const BearingLog& log) {
  for (const auto& lines : {faults_of(log), notes_of(log), log.damage}) {
    for (const std::string& line : lines) why += "; " + line;
  }
  return std::runtime_error(why);
}

std::size_t index_of(const BearingLog& log, const std::string& station) {
  const auto found = std::ranges::find(log.stations, station);
  if (found == log.stations.end())
    throw failure("--recording: no usable bearings of station '" + station + "'", log);
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

std::runtime_error no_delay(const BearingLog& log, const DelayFit& fit) {
  return failure(
      fmt::format("no delay found: the station and another one saw the same object at {} instants, "
                  "and {} more were left out because a station saw several objects. At least 10 "
                  "instants are needed, and an object that moves fast, to and fro",
                  fit.seconds, fit.several),
      log);
}

CommandReport report_on(const BearingLog& log, const DelayFit& fit, const std::string& station) {
  CommandReport report{{}, notes_of(log), log.damage};
  report.summary.push_back(fmt::format(
      "{}: pictures are stamped {:.1f} +- {:.1f} ms too {}, measured at {} instants; the "
      "lines miss each other by {:.1f} times what is expected",
      station, 1e3 * std::abs(fit.late_s->value), 1e3 * fit.late_s->sd,
      fit.late_s->value < 0.0 ? "early" : "late", fit.seconds, fit.misfit));
  if (fit.several > 0)
    report.notes.push_back(fmt::format("{} instants with several objects: left out", fit.several));
  std::ranges::copy(faults_of(log), std::back_inserter(report.faults));
  return report;
}

struct FoundDelay {
  Measured late_s;
  bool by_arrival;  // else by sender reports, or by the camera
  CommandReport report;
};

FoundDelay by_bearings(const std::vector<std::string>& recordings,
                       const station::StationSettings& settings) {
  const BearingLog log = read_bearings(recordings);
  const std::size_t wanted = index_of(log, settings.id);
  const bool by_arrival = is_by_arrival(log, wanted);
  const DelayFit fit = fit_delay(log.bearings, log.errors, wanted);
  if (!fit.late_s) throw no_delay(log, fit);
  return {*fit.late_s, by_arrival, report_on(log, fit, settings.id)};
}

double row_readout_s(const station::ChosenCamera& camera) {
  if (const auto* v4l2 = camera.as<camera::V4l2Kind>()) return v4l2->v4l2.row_readout_s;
  const auto* rtsp = camera.as<camera::RtspKind>();
  return rtsp == nullptr ? 0.0 : rtsp->rtsp.row_readout_s;
}

FoundDelay by_light(const DelayOptions& o, const station::StationSettings& settings) {
  const LightRecording seen = read_light(o.light, o.blinking, row_readout_s(settings.camera));
  const LightFit fit = fit_light(seen.samples, o.blinking);
  const std::string where = fmt::format("the light at pixel {:.0f}, {:.0f} of {} pictures",
                                        seen.pixel.x(), seen.pixel.y(), seen.samples.size());
  if (!fit.late_s) {
    throw std::runtime_error(fmt::format(
        "no delay found: {} does not follow a period of {:g} s ({:.1f} sigmas). Is it the only "
        "light that blinks, and does the camera rest?",
        where, o.blinking.period_s, fit.contrast));
  }
  return {*fit.late_s,
          seen.by_arrival,
          {{fmt::format("{}: pictures are stamped {:.1f} +- {:.1f} ms too {}, measured by {}",
                        settings.id, 1e3 * std::abs(fit.late_s->value), 1e3 * fit.late_s->sd,
                        fit.late_s->value < 0.0 ? "early" : "late", where)},
           {},
           {}}};
}

}  // namespace

CLI::App* add_delay(CLI::App& app, DelayOptions& o) {
  CLI::App* delay = app.add_subcommand(
      "delay",
      "The constant delay of a camera's pictures, out of recordings in which other stations saw "
      "the same object, or of a light that GNSS time switches. One object that moves fast, to and "
      "fro, for a minute or more.");
  add_station(*delay, o.station);
  auto* source = delay->add_option_group("source");
  source->add_option("--recording", o.recordings,
                     "log of the bus, as ols-logger writes it; several");
  source->add_option("--light", o.light,
                     "folder of an event that the station has recorded at rest, with the light");
  source->require_option(1);
  delay->add_option("--period", o.blinking.period_s, "[s] of the light; periods begin at UTC 0")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 60.0));
  delay
      ->add_option("--lit", o.blinking.lit_s,
                   "[s] for which it is on, from the beginning of a period")
      ->capture_default_str()
      ->check(CLI::Range(0.001, 60.0));
  delay->add_flag("--write", o.write, "change [camera] of the station's configuration");
  return delay;
}

int run_delay(const DelayOptions& o) {
  constexpr double kLeastSd_s = 1e-4;  // of a configuration
  const std::string path = config_path(o.station), text = config_text(path);
  const station::StationSettings settings = station::load_station_settings(path);
  const FoundDelay found =
      o.light.empty() ? by_bearings(o.recordings, settings) : by_light(o, settings);
  const DelayKeys keys = keys_of(settings.camera, found.by_arrival);
  const int status = tell(found.report);
  const double delay_s = keys.delay_s + found.late_s.value;
  check_range(settings.camera, keys.value, delay_s);
  const setup::Values before = setup::flat(text);
  setup::Values now = before;
  set(now, "camera." + keys.value, delay_s);
  set(now, "camera." + keys.sd, std::max(found.late_s.sd, kLeastSd_s));
  tell_changes(before, now);
  if (o.write) write_changes(path, text, before, now);
  return status;
}

}  // namespace ols::calibration
