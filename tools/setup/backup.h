// One file with all that makes a host what it is: configuration, keys, calibrations, states.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

// Throws std::runtime_error. The file holds private keys: its mode is 0600.
void back_up(const Host& host, const std::string& file);
// Returns the units to start. A trust list or settings that are newer than the backup's stay, and
// so do marks against replays. Throws std::runtime_error, before anything is written, for a file
// that holds anything else.
std::vector<std::string> restore(const Host& host, const std::string& file);

// Whether this member of an archive ("etc/ols/alfa.toml") belongs into a backup. Pure.
bool is_of_backup(const std::string& member);
// The units that were enabled; of a host on which nothing was, those that its configuration wants.
// Pure.
std::vector<std::string> units_of(const std::vector<std::string>& members);

}  // namespace ols::setup
