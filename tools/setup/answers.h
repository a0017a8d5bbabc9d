// The input of ols-setup for a host: a file, or a person's answers.
//
//   role = "station"                # or "centre"
//   interface = "eth0"              # the interface to the other hosts; left out: none
//   invitation = "…"                # only for a station: printed by ols-setup at the centre
//   neighbours = ["10.0.0.1"]       # other hosts of the site; they give the time if GNSS does not
//   serial = ["/dev/ttyUSB0"]       # where to search for devices; left out: all serial adapters
//   [station]                       # keys of its configuration file (docs/configuration.md)
//   id = "alfa"
//   [station.pose]
//   …
//
//   role = "centre"
//   site = "airfield"
//   root = "/media/stick/root.key"  # the site's root key; created there if it does not exist
//   [fusion]                        # [logger], [exporter], [console] likewise
//
// Pure.
#pragma once

#include <string>
#include <vector>

#include "tools/key/invitation.h"
#include "tools/setup/flat_toml.h"

namespace ols::setup {

struct Answers {
  bool is_station = true;
  std::string interface {};  // empty: the loopback interface lo
  std::vector<std::string> serial{}, neighbours{};
  std::string gnss{};            // device of the receiver that gpsd should read
  std::string station{};         // id
  key::Invitation invitation{};  // only for a station
  std::string site{}, root{};    // only for the centre
  Values values{};               // all answers: "station.pose.heading_deg"
};

// The devices of camera and mount may be missing: ols-setup can search for them. Throws ConfigError
// naming `name`, line and key.
Answers read_answers(const std::string& text, const std::string& name);

// Each function makes the text of a program's configuration file from the answers of its section,
// with the trust mode `require`. Throws ConfigError naming `name` if an answer is missing.
std::string station_file(const Values& station, const std::string& name);
std::string fusion_file(const Values& fusion, const std::string& name);
std::string logger_file(const Values& logger, const std::string& name);
std::string exporter_file(const Values& exporter, const std::string& name);
std::string console_file(const Values& console, const std::string& name);

}  // namespace ols::setup
