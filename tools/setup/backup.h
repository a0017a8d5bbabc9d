// One file with everything that identifies a host: configuration, keys, calibrations, states.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

// Throws std::runtime_error. The file holds private keys: its mode is 0600.
void back_up(const Host& host, const std::string& file);
// Returns the units to start. A trust list or settings newer than those in the backup are not
// replaced, nor are marks against replays. If the file holds anything that is not part of a backup,
// throws std::runtime_error before anything is written.
std::vector<std::string> restore(const Host& host, const std::string& file);

// Whether this member of an archive ("etc/ols/alfa.toml") belongs to a backup. Pure.
bool is_of_backup(const std::string& member);
// The units that were enabled; if there are none, those that the host's configuration needs. Pure.
std::vector<std::string> units_of(const std::vector<std::string>& members);

}  // namespace ols::setup
