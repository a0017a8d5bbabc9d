#include "tools/doctor/examination.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/config/configuration_files.h"
#include "base/config/toml_config.h"
#include "base/files/small_file.h"
#include "base/process/clocks.h"
#include "bridge/bridge_config.h"
#include "central/app/fusion_settings.h"
#include "console/add_user.h"
#include "console/console_config.h"
#include "cue/cue_config.h"
#include "edge/calibration/mount_record.h"
#include "edge/camera/aravis/aravis_kind.h"
#include "edge/camera/rtsp/rtsp_kind.h"
#include "edge/config/config.h"
#include "edge/messages/messages_bus.h"
#include "edge/mount/onvif/onvif_kind.h"
#include "edge/mount/onvif/service_address.h"
#include "edge/ptu/ptu_kind.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "export/export_config.h"
#include "export/readiness.h"
#include "tools/doctor/bus_listener.h"
#include "tools/doctor/judge_bridge.h"
#include "tools/doctor/judge_devices.h"
#include "tools/doctor/judge_host.h"
#include "tools/doctor/judge_site.h"
#include "tools/doctor/kept_list.h"
#include "tools/doctor/probe.h"
#include "tools/logger/logger_config.h"

namespace ols::doctor {
namespace {

namespace fs = std::filesystem;

// Why the file at `path` is refused, and what to do.
Finding refused(const std::string& path, const ConfigError& error) {
  const std::string what = std::string("configuration: ") + error.what();
  if (::access(path.c_str(), F_OK) != 0) {
    return fail(what, "there is no such file: is its name right? ols-setup writes these files");
  }
  if (fs::is_directory(path)) return fail(what, "this is a folder: name the file in it");
  if (::access(path.c_str(), R_OK) != 0) return fail(what, "run ols-doctor with sudo");
  return fail(what, "correct that line; docs/configuration.md lists every key");
}

// If the sensor is on a serial line, the line is examined first.
Findings examine_inclinometer(const station::ChosenInclinometer& inclinometer, double patience_s) {
  Findings findings;
  if (const auto* dpg2 = inclinometer.as<sensors::Dpg2Kind>()) {
    const auto line = judge_line("inclinometer", look_at_line(dpg2->dpg2.device, dpg2->dpg2.baud));
    if (line) findings.push_back(*line);
    if (line && line->verdict == Verdict::kFail) return findings;
  }
  findings.push_back(judge(ask_inclinometer(*inclinometer, patience_s)));
  return findings;
}

// It asks the lens for its version and positions; nothing moves.
Findings examine_lens(const lens::LensMotorConfig& config, double patience_s) {
  Findings findings;
  const auto line = judge_line("lens", look_at_line(config.device, config.baud));
  if (line) findings.push_back(*line);
  if (!line || line->verdict != Verdict::kFail) {
    findings.push_back(judge(ask_lens(config, patience_s)));
  }
  return findings;
}

// GigE Vision cameras and FLIR's units are asked more than a station asks them.
Findings examine_camera(const station::ChosenCamera& camera, double patience_s) {
  if (const auto* gige = camera.as<camera::AravisKind>()) return judge(ask_camera(gige->aravis));
  return {judge(ask_camera(*camera, patience_s))};
}

Findings examine_mount(const station::ChosenMount& mount, double patience_s) {
  if (const auto* flir = mount.as<ptu::PtuKind>()) return judge(ask_ptu(flir->unit));
  return {judge(ask_mount(*mount, patience_s))};
}

// Nothing moves here: ols-calibrate does that, if a person wants it.
Findings examine_onvif(const station::StationSettings& settings) {
  const auto* mount = settings.mount.as<onvif::OnvifKind>();
  if (mount == nullptr) return {};
  constexpr std::size_t kLongest = 4096;
  std::string record;
  try {
    record = read_small_file(
        (fs::path(settings.state_folder) / "calibrations" / settings.id / station::kMountRecord)
            .string(),
        kLongest);
  } catch (const std::system_error&) {  // not measured, or not here
  }
  Findings findings{judge_measured_mount(record, settings.id)};
  const auto* pictures = settings.camera.as<camera::RtspKind>();
  if (pictures == nullptr) return findings;
  const auto other =
      judge_hosts(onvif::host_of(pictures->rtsp.url), onvif::host_of(mount->onvif.url));
  if (other) findings.push_back(*other);
  return findings;
}

// Devices that only the station may use while it runs, and the clock, which it reports itself.
Findings examine_devices(const station::StationSettings& settings, double patience_s) {
  Findings findings = examine_camera(settings.camera, patience_s);
  append(findings, examine_mount(settings.mount, patience_s));
  if (settings.inclinometer->is_configured()) {
    append(findings, examine_inclinometer(settings.inclinometer, patience_s));
  }
  if (!settings.lens.device.empty()) append(findings, examine_lens(settings.lens, patience_s));
  if (!settings.gpio.chip.empty()) findings.push_back(judge(ask_gpio(settings.gpio)));
  if (settings.gnss->is_configured()) {
    findings.push_back(judge(ask_gnss(*settings.gnss, patience_s)));
  }
  findings.push_back(judge(ask_clock(settings.clock, patience_s)));
  return findings;
}

Findings examine_host(const station::StationSettings& settings) {
  Findings findings;
  if (!settings.recorder.folder.empty()) {
    findings.push_back(judge(look_at_folder("recordings", settings.recorder.folder,
                                            settings.recorder.disk_reserve_bytes)));
  }
  append(findings, judge(station::report_on(station::read_host(settings.host), settings.host)));
  return findings;
}

Findings examine_units(const std::vector<std::string>& units) {
  Findings findings;
  for (const UnitFacts& unit : look_at_units(units)) {
    if (const auto finding = judge(unit)) findings.push_back(*finding);
  }
  return findings;
}

std::string unit_of(const std::string& path) {
  return "ols-station@" + fs::path(path).stem().string() + ".service";
}

bool runs_as_service(const std::string& path) {
  for (const UnitFacts& unit : look_at_units({unit_of(path)})) {
    if (unit.active == "active") return true;
  }
  return false;
}

Findings examine_own(const station::StationSettings& settings, const std::string& path,
                     const BusFacts& bus, double patience_s) {
  const auto own = bus.stations.find(settings.id);
  if (own != bus.stations.end()) return judge(own->second);
  if (runs_as_service(path)) {
    return {fail("station: " + settings.id + " runs, but is not heard; its devices are left alone",
                 "systemctl status " + unit_of(path) + "; is lcm_url the one of this file?")};
  }
  Findings findings{fail("station: " + settings.id + " does not run; its devices are asked now",
                         "systemctl enable --now " + unit_of(path))};
  append(findings, examine_devices(settings, patience_s));
  return findings;
}

// A tripod has only the list that its station has received and stored.
trust::TrustConfig own_trust(const station::StationSettings& settings) {
  trust::Environment environment = station::trust_environment(settings);
  if (environment.state.empty()) environment.state = "/var/lib/ols";
  return with_kept_list(settings.trust, environment, settings.id);
}

// With the last status of each station that it hears.
Findings examine_station(const std::string& path, const Request& request,
                         std::map<std::string, std::string>& statuses) {
  station::StationSettings settings;
  try {
    settings = station::load_station_settings(path);
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  }
  Findings findings{ok("configuration: " + path + ", station " + settings.id)};
  const BusFacts bus = listen(settings.lcm_url, own_trust(settings), request.listen_s, settings.id);
  for (const auto& [id, station] : bus.stations) statuses[id] = station.text;
  append(findings, judge(bus));
  append(findings, examine_own(settings, path, bus, request.patience_s));
  append(findings, examine_onvif(settings));
  append(findings, examine_host(settings));
  if (bus.trouble.empty()) append(findings, judge_company(bus, settings.id));
  return findings;
}

Findings examine_fusion(const std::string& path, const Request& request,
                        std::map<std::string, std::string>& statuses) {
  try {
    const fusion::FusionSettings settings = fusion::load_fusion_settings(path);
    Findings findings{ok("configuration: " + path)};
    const BusFacts bus = listen(settings.lcm_url, settings.trust, request.listen_s);
    for (const auto& [id, station] : bus.stations) statuses[id] = station.text;
    append(findings, judge(bus));
    if (bus.trouble.empty()) append(findings, judge_company(bus, ""));
    return findings;
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  }
}

Findings examine_logger(const std::string& path) {
  try {
    const logger::LoggerConfig config = logger::load_logger_config(path);
    return {ok("configuration: " + path),
            judge(look_at_folder("logs", config.folder, config.disk_reserve_bytes))};
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  }
}

Findings examine_console(const std::string& path) {
  try {
    const console::ConsoleConfig config = console::load_console_config(path);
    const auto users = console::read_users(config.users);
    for (const std::string& file : {config.certificate, config.key}) {
      if (!file.empty()) read_small_file(file, 1 << 20);
    }
    const std::string problem = serving_problem(config, !users.empty());
    if (!problem.empty()) return {fail("console: " + problem, "see docs/console.md")};
    return {ok("configuration: " + path),
            ok("console: " + (users.empty() ? "for this host alone, without log-in"
                                            : std::to_string(users.size()) + " users may log in"))};
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  } catch (const std::exception& error) {
    return {fail(std::string("console: ") + error.what(),
                 "correct that file, or let the user ols read it; docs/console.md")};
  }
}

Findings examine_export(const std::string& path) {
  try {
    const exports::ExportConfig config = exports::load_export_config(path);
    exports::check_files(config);
    static_cast<void>(exports::site_context(config, exports::formats_of(config)));
    const std::size_t outputs = config.outputs.size();
    return {ok("configuration: " + path),
            outputs > 0 ? ok("export: " + std::to_string(outputs) + " outputs")
                        : warn("export: no output", "add an [[output]]; docs/exports.md")};
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  } catch (const std::exception& error) {
    return {fail(std::string("export: ") + error.what(), "see docs/exports.md")};
  }
}

Findings examine_cue(const std::string& path) {
  try {
    const cues::CueConfig config = cues::load_cue_config(path);
    const std::size_t inputs = config.inputs.size();
    return {ok("configuration: " + path),
            inputs > 0 ? ok("cues: " + std::to_string(inputs) + " inputs")
                       : warn("cues: no input", "add an [[input]]; docs/cues.md")};
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  } catch (const std::exception& error) {
    return {fail(std::string("cues: ") + error.what(), "see docs/cues.md")};
  }
}

// Empty if there is none.
std::string text_of_status(const std::string& path) {
  try {
    return path.empty() ? "" : read_small_file(path, 1 << 20);
  } catch (const std::exception&) {
    return "";
  }
}

Findings examine_bridge(const std::string& path) {
  try {
    const bridge::BridgeConfig config = bridge::load_bridge_config(path);
    Findings findings{ok("configuration: " + path)};
    append(findings, judge_bridge(text_of_status(config.status_file), clock_utime_us()));
    return findings;
  } catch (const ConfigError& error) {
    return {refused(path, error)};
  }
}

// Of the exporter, only the state of its service is examined.
Findings examine_program(const std::string& name, const std::string& path, const Request& request,
                         std::map<std::string, std::string>& statuses) {
  if (name == "fusion") return examine_fusion(path, request, statuses);
  if (name == "logger") return examine_logger(path);
  if (name == "console") return examine_console(path);
  if (name == "bridge") return examine_bridge(path);
  if (name == "export") return examine_export(path);
  if (name == "cue") return examine_cue(path);
  return {};
}

}  // namespace

Request find_configurations(const std::string& folder) {
  Request request;
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().stem();
    if (is_station_file(name)) request.stations.push_back(entry.path());
    if (is_program_file(name)) request.programs[name] = entry.path();
  }
  std::sort(request.stations.begin(), request.stations.end());
  return request;
}

Examination examine(const Request& request) {
  if (request.stations.empty() && !request.programs.contains("fusion")) {
    return {{fail("configuration: none found",
                  "copy station.toml of /usr/share/ols/examples to /etc/ols, or name a file: "
                  "ols-doctor --config FILE")},
            {}};
  }
  Examination examination;
  Findings& findings = examination.findings;
  std::vector<std::string> units{"ols-bus.service", "ols-time.service", "ols-logger.service"};
  for (const std::string& path : request.stations) {
    append(findings, examine_station(path, request, examination.statuses));
    units.push_back(unit_of(path));
  }
  for (const std::string_view name : kProgramFiles) {
    const auto path = request.programs.find(std::string(name));
    if (path == request.programs.end()) continue;
    append(findings, examine_program(path->first, path->second, request, examination.statuses));
    if (name != "logger") units.push_back(std::string("ols-").append(name).append(".service"));
  }
  append(findings, examine_units(units));
  return examination;
}

}  // namespace ols::doctor
