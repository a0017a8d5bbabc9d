// The contents of ols-console's configuration file: docs/configuration.md.
#pragma once

#include <string>
#include <vector>

#include "base/trust/trust_config.h"
#include "console/incidents/incident_book.h"

namespace ols::config {
struct Section;
}
namespace ols::console {

struct ConsoleConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string address = "127.0.0.1";
  int port = 8080;
  std::vector<std::string> host_names;  // names that browsers may use for this host, besides the
                                        // address
  std::string certificate, key;         // PEM files; both empty: no TLS
  std::string users = "/var/lib/ols/console-users";
  std::string incidents_folder = "/var/lib/ols/incidents";  // created when it is first needed
  IncidentRecording incident_recording;
  std::string maps_folder = "/var/lib/ols/maps";  // the users' own maps; the folder need not exist
  std::string land_folder;  // folder of `ols-land import`; empty: there is no land model
  double session_s = 12.0 * 3600.0;
  double control_timeout_s = 60.0;
  // The console connects to stations' video sockets only in these networks. The limit is needed
  // because the addresses come over the bus, where anybody may write.
  std::vector<std::string> video_networks = {"127.0.0.0/8",    "10.0.0.0/8", "172.16.0.0/12",
                                             "192.168.0.0/16", "::1/128",    "fc00::/7"};
  trust::TrustConfig trust;
};

config::Section console_section(ConsoleConfig& config);  // the whole file
// Throws ConfigError.
ConsoleConfig load_console_config(const std::string& path);
// Parses a text instead of a file. Errors show `name` instead of the path.
ConsoleConfig parse_console_config(const std::string& text, const std::string& name);

std::string address_problem(const std::string& address);  // what is wrong with an address; empty:
                                                          // nothing
bool is_loopback(const std::string& address);
// Why the console must not serve on its configured address; empty: it may. TLS and users are
// required on every address except loopback.
std::string serving_problem(const ConsoleConfig& config, bool has_users);
// Whether the Host header of a request names this console. Without this check, any web page could
// send requests here, through a DNS name that resolves to this address.
bool is_own_host(const ConsoleConfig& config, const std::string& host);

}  // namespace ols::console
