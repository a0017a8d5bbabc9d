// The devices that ols-setup can find: one row for each kind of camera or mount. Nothing is moved.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/setup/flat_toml.h"

namespace ols::setup {

// A device that was found.
struct Found {
  std::string words;  // for a person: "Telescope Simulator at localhost:7624"
  Values values;      // what makes it the station's device: "station.mount.kind" and so on
  // Address of an ONVIF camera's device service. Such a camera is asked for the rest after it is
  // chosen, because that needs a login.
  std::string onvif{};
};

// Where to search.
struct Search {
  std::vector<std::string> lines{};  // serial devices
  std::string indi_host = "localhost";
  int indi_port = 7624;
  int pelco_address = 1;
};

struct Finder {
  std::string kind;    // the value of the key `kind`; "onvif": also the camera's stream
  std::string called;  // what a person calls such a device
  std::function<std::vector<Found>(const Search&)> find;
};

// In each table, the first kind is the default of the station's configuration.
const std::vector<Finder>& camera_finders();
const std::vector<Finder>& mount_finders();

// Runs these finders. A line on which one has found a device is not searched by the next.
std::vector<Found> find_all(const std::vector<Finder>& finders, Search search);

// The TOML value of a key of a found device; null: it has none.
const std::string* value_of(const Found& found, const std::string& key);

}  // namespace ols::setup
