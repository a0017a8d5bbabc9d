#include "export/export_bus.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>
#include <utility>

#include "base/boot_id.h"
#include "base/channel_names.h"

namespace ols::exports {
namespace {

// A second of many targets: a file that is written must not cost any.
constexpr QueueLimits kTargetLimits{.messages = 10'000, .bytes = 16'000'000};

std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config) {
  trust::Self self;
  self.name = kMemberName;
  self.boot_id = draw_boot_id();
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

}  // namespace

ExportBus::ExportBus(std::string url, const trust::TrustConfig& trust, Handler handler)
    : url_(std::move(url)), handler_(std::move(handler)), connector_(url_, open_trust(trust)) {}

void ExportBus::connect(double now_s, double wait_s) {
  bus_ = connector_.take(now_s, wait_s);
  if (!bus_) {
    const std::string& why = connector_.trouble();
    if (why.empty() || why == trouble_) return;
    trouble_ = why;
    spdlog::warn("no bus, retrying every second: {}", why);
    return;
  }
  bus_->subscribe(std::string(kTargetChannel), handler_, kTargetLimits);
  bus_->subscribe(station_channel(kStatusChannel, ".+"), handler_);
  bus_->subscribe(station_channel(kBearingChannel, ".+"), handler_);
  spdlog::info("connected to {}", url_);
}

void ExportBus::turn(double now_s, int wait_ms) {
  if (!bus_) {
    connect(now_s, 0.0);
    if (!bus_) std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    return;
  }
  bus_->handle(wait_ms);
  monitor_.look(bus_->traffic(), now_s);
  if (!bus_->is_deaf()) return;
  trouble_ = "no messages arrive any more, not even this program's own";
  spdlog::warn("no bus, retrying every second: {}", trouble_);
  bus_.reset();
  monitor_.connection_ended();
}

}  // namespace ols::exports
