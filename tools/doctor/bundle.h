// Collects all that a remote helper needs to know about this host into one file without secrets.
#pragma once

#include <map>
#include <string>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct BundleContents {
  std::string version;  // of the product
  Findings findings;
  std::string configuration_folder;                  // its .toml, .env and .conf files are included
  std::map<std::string, std::string> statuses = {};  // last heard, by station
};

// Writes a gzipped tar archive of the contents and of this host's journal, services, clock, network
// and disks. Throws std::runtime_error if it cannot be written. Failed queries are reported in the
// archive.
void write_bundle(const std::string& file, const BundleContents& contents);

}  // namespace ols::doctor
