#include "tools/exporter/exporter_config.h"

#include "base/config/config_common.h"
#include "base/net/ip_endpoint.h"

namespace ols::exporter {

config::Section exporter_section(ExporterConfig& config) {
  return {
      "",
      "",
      {config::bus_url(config.lcm_url),
       config::text("address", config.address,
                    "ADDRESS:PORT to serve on; it has no log-in, so keep it from foreign networks.",
                    [](const std::string& text) { parse_endpoint(text); }),
       config::text("bridge_status", config.bridge_status,
                    "Status file of the ols-bridge on this host, whose state is then served as "
                    "well; empty: none.")},
      {trust::trust_section(config.trust)}};
}

ExporterConfig load_exporter_config(const std::string& path) {
  return config::load(path, exporter_section);
}

}  // namespace ols::exporter
