// Collects in one file, without secrets, everything that a remote helper needs to know about this
// host.
#pragma once

#include <map>
#include <string>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct BundleContents {
  std::string version;  // of the product
  Findings findings;
  std::string configuration_folder;                  // its .toml, .env and .conf files are included
  std::map<std::string, std::string> statuses = {};  // the last status of each station
};

// Writes a gzipped tar archive with these contents and the states of this host's journal, services,
// clock, network and disks. If a state cannot be queried, the archive says so. Throws
// std::runtime_error if the archive cannot be written.
void write_bundle(const std::string& file, const BundleContents& contents);

}  // namespace ols::doctor
