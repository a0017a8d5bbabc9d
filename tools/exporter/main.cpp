// ols-exporter: the site's statuses for Prometheus. Parses, loads, wires and loops.
#include <prometheus/collectable.h>
#include <prometheus/exposer.h>

#include <algorithm>
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
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "tools/exporter/bridge_metrics.h"
#include "tools/exporter/exporter_config.h"
#include "tools/exporter/site_metrics.h"
#include "wire/fusion_status.h"
#include "wire/station_status.h"

namespace {

constexpr int kTurn_ms = 200;
constexpr double kStatus_s = 60.0;  // the line of status does not change

// Written by the main thread, read by those of the web server.
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
  void receive(const Status& status) {
    const std::lock_guard lock(mutex_);
    metrics_.receive(status, ols::clock_monotonic_s());
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
                  if (const auto status = ols::wire::decode_status(message)) told.receive(*status);
                });
  bus.subscribe(std::string(ols::kFusionStatusChannel), [&told](const ols::BusMessage& message) {
    if (const auto status = ols::wire::decode_fusion_status(message)) told.receive(*status);
  });
}

int run(const ols::exporter::ExporterConfig& config) {
  const auto told = std::make_shared<Told>(config.bridge_status);
  prometheus::Exposer server(config.address, 1);
  server.RegisterCollectable(told);
  const auto signatures = open_trust(config.trust);
  ols::BusConnector connector(config.lcm_url, signatures);
  std::unique_ptr<ols::LcmBus> bus;
  ols::ServiceNotifier service_manager;
  const std::string page = "serves http://" + config.address + "/metrics";
  service_manager.ready(page);
  ols::write_to_journal(
      {.text = "ready: http://" + config.address + "/metrics", .id = ols::event::kReady});
  const auto turn = [&](double now_s) {
    if (signatures) told->know(signatures->stations());
    if (bus && bus->is_deaf()) bus.reset();
    if (!bus) {
      bus = connector.take(now_s, 1e-3 * kTurn_ms);
      if (bus) listen(*bus, *told);
    } else {
      bus->handle(kTurn_ms);
      told->hear_distrusted(bus->traffic());
    }
  };
  serve(service_manager, kStatus_s, turn, [&] { return page; });
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{
      "Serves the statuses of the site's stations and fusion to Prometheus (docs/fleet.md)"};
  app.set_version_flag("--version", OLS_VERSION);
  ols::ServiceOptions options;
  std::string address;
  add_service_options(app, options);
  app.add_option("--address", address, "ADDRESS:PORT, in place of the configuration's");
  if (const auto status = ols::parse_command_line(app, argc, argv, "ols-exporter")) return *status;
  return ols::run_service("ols-exporter", ols::InvalidArgument::kFailure, [&] {
    auto config = configuration_of(options, ols::exporter::load_exporter_config);
    if (!address.empty()) config.address = address;
    return options.check_config ? 0 : run(config);
  });
}
