// ols-exporter: the site's statuses for Prometheus. Parses, loads, wires and loops.
#include <prometheus/collectable.h>
#include <prometheus/exposer.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>
#include <exception>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "base/bus/bus_connector.h"
#include "base/bus/channel_names.h"
#include "base/files/small_file.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/command_line.h"
#include "base/process/service_notifier.h"
#include "base/process/shutdown.h"
#include "tools/exporter/bridge_metrics.h"
#include "tools/exporter/exporter_config.h"
#include "tools/exporter/site_metrics.h"
#include "wire/fusion_status.h"
#include "wire/station_status.h"

namespace {

constexpr int kTurn_ms = 200;

// Heard by the main thread, told by those of the web server.
class Told : public prometheus::Collectable {
 public:
  explicit Told(std::string bridge_status) : bridge_status_(std::move(bridge_status)) {}

  std::vector<prometheus::MetricFamily> Collect() const override {
    std::vector<prometheus::MetricFamily> all = of_bridge();
    const std::lock_guard lock(mutex_);
    std::ranges::move(metrics_.families(ols::clock_monotonic_s()), std::back_inserter(all));
    return all;
  }
  template <class Status>
  void hear(const Status& status) {
    const std::lock_guard lock(mutex_);
    metrics_.hear(status, ols::clock_monotonic_s());
  }
  void know(std::vector<std::string> enrolled) {
    const std::lock_guard lock(mutex_);
    metrics_.know(std::move(enrolled));
  }
  void hear_distrusted(const ols::BusTraffic& traffic) {
    std::map<std::string, double> by_reason;
    for (std::size_t i = 0; i < traffic.distrusted.size(); ++i) {
      by_reason[to_string(static_cast<ols::trust::Distrust>(i))] =
          static_cast<double>(traffic.distrusted[i]);
    }
    const std::lock_guard lock(mutex_);
    metrics_.hear_distrusted(std::move(by_reason));
  }

 private:
  std::vector<prometheus::MetricFamily> of_bridge() const {
    if (bridge_status_.empty()) return {};
    std::string text;
    try {
      text = ols::read_small_file(bridge_status_, 1 << 20);
    } catch (const std::system_error&) {
      // Without its status it counts as not running.
    }
    return ols::exporter::bridge_metrics(text, ols::clock_utime_us());
  }

  const std::string bridge_status_;
  mutable std::mutex mutex_;
  ols::exporter::SiteMetrics metrics_{OLS_VERSION};
};

std::shared_ptr<ols::trust::BusTrust> open_trust(const ols::trust::TrustConfig& config) {
  ols::trust::Self self;
  self.name = "exporter";
  self.commands = true;  // statuses of a station whose clock is wrong count too
  self.keeps_marks = true;
  return ols::trust::BusTrust::open(config, ols::trust::process_environment(), self);
}

void listen(ols::LcmBus& bus, Told& told) {
  bus.subscribe(ols::station_channel(ols::kStatusChannel, ".*"),
                [&told](const ols::BusMessage& message) {
                  if (const auto status = ols::wire::heard_status(message)) told.hear(*status);
                });
  bus.subscribe(std::string(ols::kFusionStatusChannel), [&told](const ols::BusMessage& message) {
    if (const auto status = ols::wire::heard_fusion_status(message)) told.hear(*status);
  });
}

void run(const ols::exporter::ExporterConfig& config) {
  const auto told = std::make_shared<Told>(config.bridge_status);
  prometheus::Exposer server(config.address, 1);
  server.RegisterCollectable(told);
  const auto signatures = open_trust(config.trust);
  ols::BusConnector connector(config.lcm_url, signatures);
  std::unique_ptr<ols::LcmBus> bus;
  ols::ServiceNotifier service_manager;
  service_manager.ready("serves http://" + config.address + "/metrics");
  ols::write_to_journal(
      {.text = "ready: http://" + config.address + "/metrics", .id = ols::event::kReady});
  while (!ols::shutdown_requested()) {
    const double now_s = ols::clock_monotonic_s();
    if (signatures) told->know(signatures->stations());
    if (bus && bus->is_deaf()) bus.reset();
    if (!bus) {
      bus = connector.take(now_s, 1e-3 * kTurn_ms);
      if (bus) listen(*bus, *told);
    } else {
      bus->handle(kTurn_ms);
      told->hear_distrusted(bus->traffic());
    }
    service_manager.alive(now_s);
  }
  service_manager.stopping();
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Serves the statuses of the site's stations and fusion to Prometheus (docs/fleet.md)"};
  app.set_version_flag("--version", OLS_VERSION);
  std::string config_path, lcm_url, address;
  bool check = false;
  app.add_option("--config", config_path, "Configuration file (TOML); all keys have defaults");
  app.add_option("--lcm-url", lcm_url, "Bus, in place of the configuration's");
  app.add_option("--address", address, "ADDRESS:PORT, in place of the configuration's");
  app.add_flag("--check-config", check, "Only read and check the configuration");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-exporter")) return *status;
  spdlog::set_default_logger(spdlog::stderr_color_mt("ols-exporter"));
  ols::install_shutdown_handler();
  try {
    ols::exporter::ExporterConfig config;
    if (!config_path.empty()) config = ols::exporter::load_exporter_config(config_path);
    if (!lcm_url.empty()) config.lcm_url = lcm_url;
    if (!address.empty()) config.address = address;
    if (!check) run(config);
    return 0;
  } catch (const ols::ConfigError& error) {
    std::fprintf(stderr, "ols-exporter: %s\n", error.what());
    return ols::kExitBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ols-exporter: %s\n", error.what());
    return 1;
  }
}
