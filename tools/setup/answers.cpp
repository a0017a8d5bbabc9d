#include "tools/setup/answers.h"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

#include "base/config/config_section.h"
#include "base/config/configuration_files.h"
#include "base/net/ip_endpoint.h"
#include "base/trust/trust_words.h"
#include "central/app/fusion_settings.h"
#include "console/console_config.h"
#include "edge/config/config.h"
#include "tools/exporter/exporter_config.h"
#include "tools/logger/logger_config.h"

namespace ols::setup {
namespace {

constexpr const char* kSiteBus = "\"udpm://239.255.76.67:7667?ttl=1\"";

// Makes the key optional in every form of the section that has it.
void make_optional(config::Section& section, const std::string& inner, const std::string& key) {
  for (config::Section& candidate : section.sections) {
    if (candidate.name != inner) continue;
    for (config::Section& form : candidate.forms) {
      for (config::Row& row : form.rows) {
        if (row.key != key) continue;
        row.presence = config::Presence::kOptional;
        row.read = [read = row.read, key](ConfigTable& table) {
          if (table.has(key)) read(table);
        };
      }
    }
  }
}

std::string required_text(ConfigTable& table, const char* key, const char* what) {
  const std::string text = table.text(key, "");
  if (text.empty()) throw table.error(key, std::string("is missing: ") + what);
  return text;
}

// The address goes into another program's file, as one word.
void check_address(const ConfigTable& root, const std::string& address) {
  try {
    parse_endpoint(address.find(':') == std::string::npos ? address + ":123"
                                                          : "[" + address + "]:123");
  } catch (const std::invalid_argument&) {
    throw root.error("neighbours", "\"" + address + "\" is no IP address");
  }
}

// The word goes into another program's file.
void check_word(const ConfigTable& root, const char* key, const std::string& word) {
  const bool is_plain = std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("-_.:/@+").find(c) != std::string_view::npos;
  });
  if (!is_plain) throw root.error(key, "\"" + word + "\" has a character that no device has");
}

void read_station(ConfigTable& root, Answers& answers) {
  root.refuse_unknown(
      {"role", "interface", "neighbours", "serial", "gnss", "invitation", "station"});
  station::StationSettings settings;
  config::Section section = station::station_section(settings);
  make_optional(section, "camera", "device");
  make_optional(section, "mount", "device");
  make_optional(section, "camera", "url");
  for (const char* key :
       {"url", "pan_gain_deg", "tilt_gain_deg", "pan_speed_deg_s", "tilt_speed_deg_s"})
    make_optional(section, "mount", key);
  config::read(section, root.table("station"));
  if (!is_station_file(settings.id)) {
    throw root.table("station").error("id", "is the name of another file in /etc/ols");
  }
  answers.station = settings.id;
  answers.serial = root.texts("serial", {});
  answers.gnss = root.text("gnss", "");
  check_word(root, "gnss", answers.gnss);
  try {
    answers.invitation = key::invitation_from(
        required_text(root, "invitation", "ols-setup says it at the centre, or ols-key invite"));
  } catch (const std::invalid_argument& problem) {
    throw root.error("invitation", problem.what());
  }
}

void read_centre(ConfigTable& root, Answers& answers) {
  root.refuse_unknown({"role", "interface", "neighbours", "site", "root", "fusion", "logger",
                       "exporter", "console"});
  answers.site = required_text(root, "site", "a name for the site");
  try {
    trust::require_member_name(answers.site);
  } catch (const std::invalid_argument& problem) {
    throw root.error("site", problem.what());
  }
  answers.root = required_text(root, "root", "a file on a stick, for the site's root key");
  fusion::FusionSettings fusion;
  config::read(fusion::fusion_section(fusion), root.table("fusion"));
  logger::LoggerConfig logger;
  config::read(logger::logger_section(logger), root.table("logger"));
  exporter::ExporterConfig exporter;
  config::read(exporter::exporter_section(exporter), root.table("exporter"));
  console::ConsoleConfig console;
  config::read(console::console_section(console), root.table("console"));
}

// A file of the installed site: its defaults, unless the answers say otherwise.
template <class Settings>
std::string file_of(const std::string& head, config::Section (*section)(Settings&), Values values,
                    const Values& defaults, const std::string& name) {
  for (const auto& one : defaults) {
    if (find(values, one.first) == nullptr) values.push_back(one);
  }
  Settings settings;
  const std::string text = head + config::example(section(settings), values);
  ConfigFile file(text, name);
  config::read(section(settings), file.root());
  return text;
}

constexpr const char* kHead =
    "# Made by ols-setup; edit it freely: what you change is kept. All keys: "
    "docs/configuration.md.\n";

}  // namespace

Answers read_answers(const std::string& text, const std::string& name) {
  ConfigFile file(text, name);
  ConfigTable& root = file.root();
  Answers answers;
  answers.is_station = root.choice("role", "", {"station", "centre"}) == "station";
  if (!root.has("role")) throw root.error("role", "is missing: \"station\" or \"centre\"");
  answers.interface = root.text("interface", "");
  check_word(root, "interface", answers.interface);
  answers.neighbours = root.texts("neighbours", {});
  for (const std::string& address : answers.neighbours) check_address(root, address);
  answers.is_station ? read_station(root, answers) : read_centre(root, answers);
  answers.values = flat(text);
  return answers;
}

std::string station_file(const Values& station, const std::string& name) {
  return file_of(
      kHead, station::station_section, station,
      {{"lcm_url", kSiteBus}, {"state_folder", "\"/var/lib/ols\""}, {"trust.mode", "\"require\""}},
      name);
}

std::string fusion_file(const Values& fusion, const std::string& name) {
  return file_of(kHead, fusion::fusion_section, fusion,
                 {{"lcm_url", kSiteBus}, {"trust.mode", "\"require\""}}, name);
}

std::string logger_file(const Values& logger, const std::string& name) {
  return file_of(kHead, logger::logger_section, logger,
                 {{"lcm_url", kSiteBus},
                  {"status_file", "\"/run/ols/logger.json\""},
                  {"trust.mode", "\"require\""}},
                 name);
}

std::string exporter_file(const Values& exporter, const std::string& name) {
  return file_of(kHead, exporter::exporter_section, exporter,
                 {{"lcm_url", kSiteBus}, {"trust.mode", "\"require\""}}, name);
}

std::string console_file(const Values& console, const std::string& name) {
  return file_of(kHead, console::console_section, console,
                 {{"lcm_url", kSiteBus}, {"trust.mode", "\"require\""}}, name);
}

}  // namespace ols::setup
