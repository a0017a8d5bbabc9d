// What a person who is to help from afar needs to see of this host, as one file without secrets.
#pragma once

#include <map>
#include <string>

#include "tools/doctor/finding.h"

namespace ols::doctor {

struct BundleContents {
  std::string version;  // of the product
  Findings findings;
  std::string configuration_folder;                  // whose .toml, .env and .conf are put in
  std::map<std::string, std::string> statuses = {};  // as heard last, by station
};

// A gzipped tar archive: those, and journal, services, clock, network, disks of this host. Throws
// std::runtime_error if it cannot be written; what cannot be asked is said inside.
void write_bundle(const std::string& file, const BundleContents& contents);

}  // namespace ols::doctor
