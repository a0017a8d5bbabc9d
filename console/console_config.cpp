#include "console/console_config.h"

#include <algorithm>
#include <stdexcept>

#include "base/config/config_common.h"
#include "base/net/ip_networks.h"

namespace ols::console {
namespace {

const config::Unit kHours{"h", [](double v) { return 3600.0 * v; },
                          [](double v) { return v / 3600.0; }};

void check_address(const std::string& address) {
  if (const auto problem = address_problem(address); !problem.empty()) {
    throw std::invalid_argument(problem);
  }
}

// Without the port, and without the brackets of an IPv6 address.
std::string host_of(const std::string& host) {
  if (host.starts_with('[')) return host.substr(1, host.find(']') - 1);
  return host.substr(0, host.find(':'));
}

}  // namespace

config::Section console_section(ConsoleConfig& c) {
  return {
      "",
      "",
      {config::bus_url(c.lcm_url),
       config::text("address", c.address,
                    "IP address to serve on; 0.0.0.0: every interface. Away from loopback, TLS and "
                    "users are required.",
                    check_address),
       config::integer("port", c.port, 0, 65535, "", "TCP port; 0: a free one, which is logged."),
       config::texts("host_names", c.host_names,
                     "Names, beside localhost and IP addresses, by which browsers may call it."),
       config::text("certificate", c.certificate,
                    "PEM file with its certificate; ols-console-certificate makes one. Empty: no "
                    "TLS."),
       config::text("key", c.key, "PEM file with the certificate's private key."),
       config::text("users", c.users,
                    "File of those who may log in: ols-console --add-user. While there is none, "
                    "everybody on this host is an operator.",
                    config::not_empty),
       config::number("session_h", c.session_s, {0.01, 1000.0}, kHours,
                      "After this long a person logs in again."),
       config::number("control_timeout_s", c.control_timeout_s, {1.0, 3600.0}, "s",
                      "Control of a station ends this long after the last command."),
       config::texts("video_networks", c.video_networks,
                     "Networks of the stations' video sockets; no other address is asked for "
                     "pictures.")},
      {{"maps",
        "Maps of your own beside the coast lines that come with the program.",
        {config::text("folder", c.maps_folder,
                      "Folder of maps: MBTiles and PMTiles files with pictures, and folders "
                      "ZOOM/COLUMN/ROW.png. ols-map-import makes them.")}},
       {"land",
        "The land around the site (docs/land.md).",
        {config::text("folder", c.land_folder,
                      "Folder that `ols-land import` has made, as the fusion has it: skylines in "
                      "the pictures, heights of the ground. Empty: no land is known.")}},
       {"incidents",
        "What comes into the areas that operators draw.",
        {config::text("folder", c.incidents_folder,
                      "Folder of the areas and incidents. Of several consoles of a site, only one "
                      "should have areas.",
                      config::not_empty),
         config::number("record_before_s", c.incident_recording.before_s, {0.0, 3600.0}, "s",
                        "The stations that see an incident begin record this long before it."),
         config::number("record_after_s", c.incident_recording.after_s, {0.0, 3600.0}, "s",
                        "And this long after. Both 0: they record nothing.")}},
       trust::trust_section(c.trust)},
      [&c](ConfigTable& root) {
        try {
          IpNetworks{c.video_networks};
        } catch (const std::invalid_argument& bad) {
          throw root.error("video_networks", bad.what());
        }
        if (c.certificate.empty() != c.key.empty()) {
          throw root.error(c.key.empty() ? "certificate" : "key",
                           "certificate and key belong together");
        }
        if (!is_loopback(c.address) && c.certificate.empty()) {
          throw root.error("address", "away from loopback it needs certificate and key");
        }
      }};
}

ConsoleConfig load_console_config(const std::string& path) {
  return config::load(path, console_section);
}

ConsoleConfig parse_console_config(const std::string& text, const std::string& name) {
  return config::parse(text, name, console_section);
}

std::string address_problem(const std::string& address) {
  const bool good = !address.empty() && std::ranges::all_of(address, [](unsigned char c) {
    return std::isxdigit(c) != 0 || c == '.' || c == ':';
  });
  return good ? "" : "must be an IP address, as 127.0.0.1, 0.0.0.0 or ::";
}

bool is_loopback(const std::string& address) {
  return address.starts_with("127.") || address == "::1";
}

std::string serving_problem(const ConsoleConfig& config, bool has_users) {
  if (is_loopback(config.address)) return "";
  if (config.certificate.empty()) {
    return "address " + config.address + " is not loopback: it needs certificate and key";
  }
  if (!has_users) {
    return "address " + config.address + " is not loopback and " + config.users +
           " names no user: ols-console --add-user NAME --role admin";
  }
  return "";
}

bool is_own_host(const ConsoleConfig& config, const std::string& host) {
  const std::string name = host_of(host);
  if (name.empty()) return false;
  // Only a name, not an IP address, may be in somebody else's control.
  const bool is_v4 =
      std::ranges::all_of(name, [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; });
  const bool is_v6 = host.starts_with('[');
  return is_v4 || is_v6 || name == "localhost" ||
         std::ranges::find(config.host_names, name) != config.host_names.end();
}

}  // namespace ols::console
