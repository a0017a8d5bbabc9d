// Changes a station's configuration after a measurement: finds it, tells what changes, and writes.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "tools/setup/flat_toml.h"

namespace ols::calibration {

// The options of a command that names a station by its configuration, and optionally the folder of
// its calibrations.
void add_station(CLI::App& command, std::string& station);
void add_state(CLI::App& command, std::string& folder);

// The path of a station's configuration, which a person states as a path or as a name: NAME is
// /etc/ols/NAME.toml.
std::string config_path(const std::string& station);
// Throws std::runtime_error.
std::string config_text(const std::string& path);

double number_in(const setup::Values& values, const std::string& key, double otherwise);
void set(setup::Values& values, const std::string& key, double number);
// Writes each difference to standard output.
void tell_changes(const setup::Values& before, const setup::Values& now);
// Writes the differences into the file; its comments and other values stay. `text`: the file as it
// was read. Throws std::runtime_error if the file has changed since, or cannot be rewritten.
void write_changes(const std::string& path, const std::string& text, const setup::Values& before,
                   const setup::Values& now);

}  // namespace ols::calibration
