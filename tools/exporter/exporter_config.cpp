#include "tools/exporter/exporter_config.h"

#include "base/config_section.h"
#include "base/ip_endpoint.h"
#include "base/lcm_url.h"

namespace ols::exporter {

config::Section exporter_section(ExporterConfig& config) {
  return {
      "",
      "",
      {config::text("lcm_url", config.lcm_url,
                    "The bus; ttl=0: only this host, ttl=1: also the other hosts of the site.",
                    [](const std::string& url) { parse_lcm_url(url); }),
       config::text("address", config.address,
                    "ADDRESS:PORT to serve on; it has no log-in, so keep it from foreign networks.",
                    [](const std::string& text) { parse_endpoint(text); })},
      {trust::trust_section(config.trust)}};
}

ExporterConfig load_exporter_config(const std::string& path) {
  ExporterConfig config;
  ConfigFile file(path);
  config::read(exporter_section(config), file.root());
  return config;
}

}  // namespace ols::exporter
