#include "cue/cue_bus.h"

#include <spdlog/spdlog.h>

#include <chrono>
#include <thread>
#include <utility>

#include "base/boot_id.h"
#include "base/channel_names.h"
#include "cue/messages.h"

namespace ols::cues {
namespace {

std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config,
                                            std::int64_t boot_id) {
  trust::Self self;
  self.name = "cue";
  self.boot_id = boot_id;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

}  // namespace

CueBus::CueBus(std::string url, const trust::TrustConfig& trust)
    : url_(std::move(url)),
      boot_id_(draw_boot_id()),
      connector_(url_, open_trust(trust, boot_id_)) {}

void CueBus::connect(double now_s, double wait_s) {
  bus_ = connector_.take(now_s, wait_s);
  if (bus_) {
    bus_->listen();
    spdlog::info("connected to {}", url_);
    return;
  }
  const std::string& why = connector_.trouble();
  if (why.empty() || why == trouble_) return;
  trouble_ = why;
  spdlog::warn("no bus, retrying every second: {}", why);
}

void CueBus::end(const std::string& why) {
  trouble_ = why;
  spdlog::warn("no bus, retrying every second: {}", why);
  bus_.reset();
  monitor_.connection_ended();
}

void CueBus::turn(double now_s, int wait_ms) {
  if (!bus_) {
    connect(now_s, 0.0);
    if (!bus_) std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    return;
  }
  bus_->handle(wait_ms);
  monitor_.look(bus_->traffic(), now_s);
  if (bus_->is_deaf()) end("no messages arrive any more, not even this program's own");
}

void CueBus::send(const std::vector<LiveCue>& cues, std::int64_t utime_us) {
  for (const LiveCue& cue : cues) {
    if (!bus_) return;
    const Stamp stamp{utime_us, boot_id_, ++sequence_};
    if (!bus_->publish(std::string(kCueChannel), to_message(cue, stamp))) {
      end("sending fails: the network is down");
    }
  }
}

}  // namespace ols::cues
