#include "tools/calibrate/config_change.h"

#include <fmt/format.h>

#include <cstdio>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "tools/setup/kept_file.h"

namespace ols::calibration {
namespace {

constexpr const char* kConfigFolder = "/etc/ols/";
constexpr std::size_t kLargestConfig = 1'000'000;

}  // namespace

void add_station(CLI::App& command, std::string& station) {
  command
      .add_option("--station", station,
                  "its configuration, or its name: NAME is /etc/ols/NAME.toml")
      ->required();
}

void add_state(CLI::App& command, std::string& folder) {
  command.add_option("--state", folder,
                     "folder of its calibrations; else calibrations/ID in the configured "
                     "state_folder");
}

std::string config_path(const std::string& station) {
  const bool is_path = station.find('/') != std::string::npos || station.ends_with(".toml");
  return is_path ? station : kConfigFolder + station + ".toml";
}

std::string config_text(const std::string& path) { return read_small_file(path, kLargestConfig); }

double number_in(const setup::Values& values, const std::string& key, double otherwise) {
  const std::string* text = setup::find(values, key);
  return text == nullptr ? otherwise : std::stod(*text);
}

void set(setup::Values& values, const std::string& key, double number) {
  const std::string text = fmt::format("{:.6g}", number);
  for (auto& [known, value] : values) {
    if (known == key) {
      value = text;
      return;
    }
  }
  values.emplace_back(key, text);
}

void tell_changes(const setup::Values& before, const setup::Values& now) {
  for (const auto& [key, value] : now) {
    const std::string* old = setup::find(before, key);
    if (old == nullptr || *old != value)
      std::printf("%s = %s (was %s)\n", key.c_str(), value.c_str(),
                  old == nullptr ? "not stated" : old->c_str());
  }
}

void write_changes(const std::string& path, const std::string& text, const setup::Values& before,
                   const setup::Values& now) {
  if (config_text(path) != text)
    throw std::runtime_error(path + ": changed during the measurement: not written");
  const auto rewritten = setup::rewrite(text, setup::as_toml(before), setup::as_toml(now));
  if (!rewritten.text) throw std::runtime_error(path + ": " + rewritten.note);
  AtomicFile file(path);
  file.stream() << *rewritten.text;
  file.commit();
  std::printf("%s: written; restart the station\n", path.c_str());
}

}  // namespace ols::calibration
