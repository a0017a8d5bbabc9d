// Saves everything that identifies a host in one file, and restores it: configuration, keys,
// calibrations, persisted states.
#pragma once

#include <string>
#include <vector>

#include "tools/setup/host.h"

namespace ols::setup {

// Writes the file. It contains private keys, so its mode is 0600. Throws std::runtime_error.
void back_up(const Host& host, const std::string& file);
// Restores the file; returns the systemd units to start. Does not replace a trust list or settings
// that are newer than those in the backup, and never replaces the marks against replays
// (never_older.h). If the file contains anything that is not part of a backup, throws
// std::runtime_error before it writes anything.
std::vector<std::string> restore(const Host& host, const std::string& file);

// Whether this member of an archive ("etc/ols/alfa.toml") belongs to a backup. Pure.
bool is_of_backup(const std::string& member);
// The systemd units that were enabled, from the names in a backup; if there are none, the units
// that the host's configuration needs. Pure.
std::vector<std::string> units_of(const std::vector<std::string>& members);

}  // namespace ols::setup
