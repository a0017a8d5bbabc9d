// The exporter's configuration file: docs/configuration.md.
#pragma once

#include <string>

#include "base/trust/trust_config.h"

namespace ols::config {
struct Section;
}
namespace ols::exporter {

struct ExporterConfig {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  std::string address = "127.0.0.1:9316";
  std::string bridge_status;  // empty: there is no bridge on this host
  trust::TrustConfig trust{};
};

config::Section exporter_section(ExporterConfig& config);  // the whole file
// Throws ConfigError ("file:line: key: what").
ExporterConfig load_exporter_config(const std::string& path);

}  // namespace ols::exporter
