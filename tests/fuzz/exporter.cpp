// What reaches ols-exporter: a run of datagrams, each with its kind and length, that may say
// anything, and a configuration. Whatever they say, the page is of bounded size and of lines of its
// own.
#include <prometheus/text_serializer.h>

#include <sstream>
#include <string>

#include "base/bus/lcm_bus.h"
#include "base/config/config_section.h"
#include "base/config/toml_config.h"
#include "ols_msg/fusion_status_t.hpp"
#include "tests/fuzz/fuzz_input.h"
#include "tools/exporter/exporter_config.h"
#include "tools/exporter/site_metrics.h"
#include "wire/station_status.h"

namespace {

using ols::exporter::SiteMetrics;

void receive(SiteMetrics& metrics, bool is_fusion, const std::string& station,
             std::string_view bytes, double now_s) {
  ols::BusMessage message;
  message.channel = is_fusion ? "OLS_FUSION_STATUS" : "OLS_STATUS_" + station;
  message.payload.assign(bytes.begin(), bytes.end());
  if (!is_fusion) {
    if (const auto status = ols::wire::decode_status(message)) metrics.receive(*status, now_s);
    return;
  }
  ols_msg::fusion_status_t status;
  if (ols::decode_exactly(message, status)) metrics.receive(status, now_s);
}

void check(const SiteMetrics& metrics, double now_s) {
  const std::string page = prometheus::TextSerializer().Serialize(metrics.families(now_s));
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    ols::fuzz::require(line.starts_with("ols_") || line.starts_with("# HELP ols_") ||
                           line.starts_with("# TYPE ols_"),
                       "a line is one of ours");
  }
}

void configure(std::string_view text) {
  try {
    ols::ConfigFile file(text, "fuzz");
    ols::exporter::ExporterConfig config;
    ols::config::read(ols::exporter::exporter_section(config), file.root());
  } catch (const ols::ConfigError& error) {
    ols::fuzz::require(std::string(error.what()).starts_with("fuzz"), "an error names the file");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size > 8192) return 0;
  ols::fuzz::Input input(data, size);
  if ((input.byte() & 1) != 0) {
    configure(input.rest());
    return 0;
  }
  SiteMetrics metrics("1");
  double now_s = 0.0;
  while (!input.empty()) {
    const std::uint8_t kind = input.byte();
    const std::size_t high = input.byte();
    const std::size_t length = 256 * high + input.byte();
    const char station[] = {"abcdefgh"[(kind >> 1) & 7], '\0'};
    now_s += (kind & 0x80) != 0 ? 1000.0 : 0.1;
    receive(metrics, (kind & 1) != 0, station, input.take(length), now_s);
  }
  check(metrics, now_s);
  return 0;
}
