// ols-config-reference: writes docs/configuration.md and the example configurations from the tables
// that the programs read by, or checks that they are up to date.
#include <cstdio>
#include <exception>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/config/config_section.h"
#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "base/process/command_line.h"
#include "bridge/bridge_config.h"
#include "central/app/fusion_settings.h"
#include "console/console_config.h"
#include "cue/cue_config.h"
#include "edge/config/config.h"
#include "export/export_config.h"
#include "sim/scenario/scenario.h"
#include "tools/exporter/exporter_config.h"
#include "tools/logger/logger_config.h"

namespace {

namespace config = ols::config;

struct Generated {
  std::string path, text;
};

template <class Settings>
std::string chapter(const std::string& heading, config::Section (*section)(Settings&)) {
  Settings defaults;
  return "\n## " + heading + "\n" + config::markdown(section(defaults));
}

config::Section scenario_section(ols::sim::Scenario& scenario) {
  return ols::sim::scenario_section(scenario, "");
}

std::string reference() {
  return "# Configuration\n\n"
         "<!-- Generated from the programs' tables: `ols-config-reference --write .` -->\n\n"
         "Every configuration file is TOML. A key that is not required has the default shown, "
         "rounded to six digits.\nAn unknown key, or a value out of range, ends the program with "
         "`file:line: key: what is wrong` before it\ntouches a device; `--check-config` does only "
         "that.\n" +
         chapter("Station: `ols-station --config`", ols::station::station_section) +
         chapter("Fusion: `ols-fusion --config`", ols::fusion::fusion_section) +
         chapter("Logger: `ols-logger --config`", ols::logger::logger_section) +
         chapter("Console: `ols-console --config`", ols::console::console_section) +
         chapter("Exports: `ols-export --config`", ols::exports::export_section) +
         chapter("Cues: `ols-cue --config`", ols::cues::cue_section) +
         chapter("Bridge: `ols-bridge --config`", ols::bridge::bridge_section) +
         chapter("Exporter: `ols-exporter --config`", ols::exporter::exporter_section) +
         chapter("Scenario: `ols-sim --scenario`", scenario_section);
}

template <class Settings>
std::string example(const std::string& head, config::Section (*section)(Settings&),
                    const std::vector<std::pair<std::string, std::string>>& values) {
  Settings settings;
  const std::string text = head + config::example(section(settings), values);
  ols::ConfigFile file(text, "example");
  config::read(section(settings), file.root());
  return text;
}

config::Section gpio_only(ols::gpio::GpioConfig& gpio) {
  return {"", "", {}, {ols::gpio::gpio_section(gpio)}};
}

std::string commented(const std::string& text) {
  std::istringstream lines(text);
  std::string line, result;
  while (std::getline(lines, line))
    if (!line.empty()) result.append("# ").append(line).append("\n");
  return result;
}

constexpr const char* kSiteBus = "\"udpm://239.255.76.67:7667?ttl=1\"";

std::string station_example() {
  const std::string head =
      "# One station: copy to /etc/ols/NAME.toml, fill in, `ols-station --config ... "
      "--check-config`, then\n# `systemctl enable --now ols-station@NAME`. docs/configuration.md "
      "lists every key.\n";
  return example(head, ols::station::station_section,
                 {{"id", "\"alfa\""},
                  {"lcm_url", kSiteBus},
                  {"pose.latitude_deg", "49.2266"},
                  {"pose.longitude_deg", "16.5969"},
                  {"pose.height_m", "310.0"},
                  {"pose.heading_deg", "45.0"},
                  {"calibration.sd.heading_deg", "0.5"},
                  {"calibration.sd.tilt_deg", "0.1"},
                  {"calibration.sd.mount_deg", "0.1"},
                  {"calibration.sd.position_m", "1.0"},
                  {"camera.device", "\"Allied Vision Technologies-02-2150A-06321\""},
                  {"lens.fx_px", "13333.3"},
                  {"lens.fy_px", "13333.3"},
                  {"mount.kind", "\"flir\""},
                  {"mount.device", "\"/dev/ols/ptu\""}}) +
         "\n# Where there are GPIO lines:\n" +
         commented(example("", gpio_only,
                           {{"gpio.chip", "\"/dev/gpiochip0\""},
                            {"gpio.stop_line", "17"},
                            {"gpio.rearm_line", "18"}}));
}

// One table of an array, which has its brackets twice; commented out.
std::string one_of_array(config::Section table, const std::string& name,
                         const std::string& sentence,
                         const std::vector<std::pair<std::string, std::string>>& values) {
  table.name = name;
  table.sentence = sentence;
  std::string text = config::example({"", "", {}, {table}}, values);
  const std::string single = "[" + name + "]";
  const auto at = text.find(single);
  if (at == std::string::npos) throw std::invalid_argument("no " + single + " in the example");
  return commented(text.replace(at, single.size(), "[" + single + "]"));
}

std::string cue_example() {
  ols::cues::CueConfig cues;
  const std::string head =
      "# Cues from outside: copy to /etc/ols/cue.toml. docs/configuration.md lists every key, "
      "docs/cues.md every\n# format. Nothing comes in before there is an [[input]].\n";
  const std::string text =
      example(head, ols::cues::cue_section,
              {{"lcm_url", kSiteBus}, {"status_file", "\"/run/ols/cue.json\""}}) +
      "\n# Tablets with TAK on this network:\n" +
      one_of_array(ols::cues::input_section(cues), "input", "One source each.",
                   {{"input.name", "\"tak\""},
                    {"input.format", "\"cot\""},
                    {"input.from", "\"udp://239.2.3.1:6969\""}});
  static_cast<void>(ols::cues::parse_cue_config(text, "example"));
  return text;
}

std::string export_example() {
  ols::exports::ExportConfig exports;
  const std::string head =
      "# Exports: copy to /etc/ols/export.toml. docs/configuration.md lists every key, "
      "docs/exports.md "
      "every\n# format. Nothing goes out before there is an [[output]].\n";
  const std::string text =
      example(head, ols::exports::export_section,
              {{"lcm_url", kSiteBus},
               {"site", "\"ols\""},
               {"status_file", "\"/run/ols/export.json\""}}) +
      "\n# Tablets with TAK on this network:\n" +
      one_of_array(ols::exports::output_section(exports), "output", "One receiver each.",
                   {{"output.name", "\"tak\""},
                    {"output.format", "\"cot\""},
                    {"output.to", "\"udp://239.2.3.1:6969?ttl=1\""}});
  static_cast<void>(ols::exports::parse_export_config(text, "example"));
  return text;
}

std::vector<Generated> generated() {
  const std::string folder = "systemd/examples/";
  return {
      {"docs/configuration.md", reference()},
      {folder + "station.toml", station_example()},
      {folder + "fusion.toml",
       example("# The fusion: copy to /etc/ols/fusion.toml. All keys have defaults: "
               "docs/configuration.md.\n",
               ols::fusion::fusion_section, {{"lcm_url", kSiteBus}})},
      {folder + "logger.toml",
       example("# The logger of the bus: copy to /etc/ols/logger.toml. All keys have defaults: "
               "docs/configuration.md.\n",
               ols::logger::logger_section,
               {{"lcm_url", kSiteBus},
                {"quota_gb", "20.0"},
                {"status_file", "\"/run/ols/logger.json\""}})},
      {folder + "console.toml",
       example("# The console: copy to /etc/ols/console.toml. All keys have defaults: "
               "docs/configuration.md.\n# For browsers of other hosts: ols-console-certificate, "
               "ols-console --add-user (docs/console.md), then\n# address, certificate and key.\n",
               ols::console::console_section,
               {{"lcm_url", kSiteBus}, {"address", "\"127.0.0.1\""}, {"port", "8080"}})},
      {folder + "bridge.toml",
       example(
           "# Between this site and others: copy to /etc/ols/bridge.toml. docs/configuration.md "
           "lists every key,\n# docs/bridge.md says what belongs into the server's files.\n",
           ols::bridge::bridge_section,
           {{"lcm_url", kSiteBus},
            {"status_file", "\"/run/ols/bridge.json\""},
            {"role", "\"site\""},
            {"region", "\"moravia\""},
            {"site", "\"airfield\""},
            {"archive.keep", "true"}})},
      {folder + "cue.toml", cue_example()},
      {folder + "export.toml", export_example()},
      {folder + "exporter.toml",
       example("# The exporter: copy to /etc/ols/exporter.toml. All keys have defaults: "
               "docs/configuration.md.\n",
               ols::exporter::exporter_section,
               {{"lcm_url", kSiteBus}, {"address", "\"127.0.0.1:9316\""}})}};
}

int run(const std::string& folder, bool write) {
  int stale = 0;
  for (const Generated& file : generated()) {
    const std::string path = folder + "/" + file.path;
    if (write) {
      ols::AtomicFile out(path);
      out.stream() << file.text;
      out.commit();
    } else if (ols::read_small_file(path, 1 << 20) != file.text) {
      std::fprintf(stderr, "%s differs from the tables: ols-config-reference --write %s\n",
                   path.c_str(), folder.c_str());
      ++stale;
    }
  }
  return stale > 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Writes the configuration reference and the examples, or checks them"};
  std::string write, check;
  auto* group = app.add_option_group("what");
  group->add_option("--write", write, "Write them into this source tree");
  group->add_option("--check", check, "Fail if those of this source tree are out of date");
  group->require_option(1);
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-config-reference"))
    return *status;
  try {
    return write.empty() ? run(check, false) : run(write, true);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-config-reference: %s\n", error.what());
    return 1;
  }
}
