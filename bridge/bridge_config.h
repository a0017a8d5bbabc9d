// The contents of ols-bridge's configuration file: docs/configuration.md.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "bridge/passage.h"

namespace ols::config {
struct Section;
}
namespace ols::bridge {

// The connection to a NATS server.
struct NatsConfig {
  std::vector<std::string> servers{"nats://127.0.0.1:4222"};
  std::string credentials;  // path of a file with a user's JWT and seed
  std::string nkey, seed;   // the public key, and the path of a file with its seed
  std::string authority;    // path of a file with trusted certificates
  std::string certificate, key;
};

// Which messages a server stores, and for how long. Live traffic passes whether or not it is
// stored.
struct ArchiveConfig {
  bool is_on = false;
  double keep_h = 24.0;
  double most_bytes = 16e9;
  std::string domain;                // JetStream domain of the server that stores the stream;
                                     // empty: the connected server
  std::vector<std::string> sources;  // sites whose streams are copied to a region
};

struct OwnershipConfig {
  bool is_on = false;
  std::string name;    // the name of this fusion among all fusions that may own a target
  std::string domain;  // JetStream domain of the server with the store of owners
  std::array<double, 4> cell_deg{-90.0, -180.0, 90.0, 180.0};  // south, west, north, east
  double margin_m = 2000.0;
};

struct BridgeConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string status_file;
  Role role = Role::kSite;
  std::string region = "region", site = "site";
  std::vector<std::string> stations, takes;
  std::vector<std::string> commands{"slew", "occlusion"};
  bool targets = false;
  double command_age_s = 1.0, live_age_s = 5.0;
  NatsConfig nats;
  ArchiveConfig archive;
  OwnershipConfig ownership;
};

// Whether every server of the configuration is reached over TLS.
bool is_over_tls(const NatsConfig& config);
config::Section bridge_section(BridgeConfig& config);  // the whole file
PassageConfig passage_of(const BridgeConfig& config);
// Throws ConfigError.
BridgeConfig load_bridge_config(const std::string& path);
// Parses a text instead of a file. Errors show `name` instead of the path.
BridgeConfig parse_bridge_config(const std::string& text, const std::string& name);

}  // namespace ols::bridge
