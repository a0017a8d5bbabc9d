#include "console/console_bus.h"

#include <spdlog/spdlog.h>

#include "base/boot_id.h"
#include "base/channel_names.h"
#include "console/messages.h"
#include "console/messages_pictures.h"

namespace ols::console {
namespace {

// Pictures are large, and only the newest counts.
constexpr QueueLimits kPictureLimits{.messages = 64, .bytes = 4'000'000};

std::shared_ptr<trust::BusTrust> open_trust(const trust::TrustConfig& config,
                                            std::int64_t boot_id) {
  trust::Self self;
  self.name = "console";
  self.boot_id = boot_id;
  self.commands = self.tells_list = true;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

}  // namespace

ConsoleBus::ConsoleBus(const std::string& url, const trust::TrustConfig& trust, Console& console)
    : url_(url),
      console_(console),
      boot_id_(draw_boot_id()),
      connector_(url, open_trust(trust, boot_id_)),
      sender_(boot_id_),
      answer_sender_(boot_id_) {}

void ConsoleBus::subscribe() {
  bus_->subscribe(station_channel(kStatusChannel, ".+"), [this](const BusMessage& message) {
    if (auto heard = station_from(message)) console_.hear(*heard, now_);
  });
  bus_->subscribe(station_channel(kBearingChannel, ".+"), [this](const BusMessage& message) {
    if (auto heard = bearing_from(message)) console_.hear_bearing(heard->first, heard->second);
  });
  bus_->subscribe(std::string(kTargetChannel), [this](const BusMessage& message) {
    if (auto heard = target_from(message)) console_.hear(*heard, now_);
  });
  bus_->subscribe(std::string(kFusionStatusChannel), [this](const BusMessage& message) {
    if (auto heard = fusion_from(message)) console_.hear(*heard, now_);
  });
  bus_->subscribe(
      station_channel(kPreviewChannel, ".+"),
      [this](const BusMessage& message) {
        if (auto heard = picture_from(message)) console_.hear(std::move(*heard));
      },
      kPictureLimits);
  bus_->subscribe(
      station_channel(kProcedureChannel, ".+"),
      [this](const BusMessage& message) {
        if (auto heard = procedure_from(message)) console_.hear(std::move(*heard));
      },
      kPictureLimits);
}

void ConsoleBus::connect(const Now& now) {
  bus_ = connector_.take(now.monotonic_s);
  if (bus_) {
    subscribe();
    if (!trouble_.empty()) console_.note("console", "", "the bus is back", now);
    trouble_.clear();
    spdlog::info("connected to {}", url_);
    return;
  }
  const std::string& why = connector_.trouble();
  if (why.empty() || why == trouble_) return;
  trouble_ = why;
  spdlog::warn("no bus, retrying every second: {}", why);
  console_.note("console", "", "no bus: " + why, now);
}

void ConsoleBus::disconnect(const std::string& why, const Now& now) {
  spdlog::warn("no bus, retrying every second: {}", why);
  console_.note("console", "", "no bus: " + why, now);
  trouble_ = why;
  bus_.reset();
  monitor_.connection_ended();
  send_failed_ = false;
}

void ConsoleBus::turn(const Now& now) {
  now_ = now;
  if (!bus_) return connect(now);
  bus_->handle(0);
  monitor_.look(bus_->traffic(), now.monotonic_s);
  note_alarms(now);
  if (send_failed_) return disconnect("sending fails: the network is down", now);
  if (bus_->is_deaf()) {
    disconnect("no messages arrive any more, not even this program's own", now);
  }
}

// Their texts count, and so change: an event is that one more or one fewer stands.
void ConsoleBus::note_alarms(const Now& now) {
  std::vector<std::string> alarms = monitor_.alarms(now.monotonic_s);
  if (alarms.size() > alarms_.size()) console_.note("alarm", "", alarms.back(), now);
  if (alarms.size() < alarms_.size()) console_.note("alarm_over", "", alarms_.back(), now);
  alarms_ = std::move(alarms);
}

void ConsoleBus::send(const std::vector<command::Order>& orders, const Now& now) {
  if (!bus_) return;
  for (const command::Order& order : orders) {
    if (!sender_.send(*bus_, order, now.utime_us)) send_failed_ = true;
  }
}

void ConsoleBus::send(const std::vector<ProcedureAnswer>& answers, const Now& now) {
  if (!bus_) return;
  for (const ProcedureAnswer& answer : answers) {
    if (!answer_sender_.send(*bus_, answer, now.utime_us)) send_failed_ = true;
  }
}

void ConsoleBus::send(const std::vector<CueOrder>& orders, const Now& now) {
  if (!bus_) return;
  for (const auto& [cue, allow] : orders) {
    if (!sender_.send(*bus_, command::CueOrder{cue, allow}, now.utime_us)) send_failed_ = true;
  }
}

std::string ConsoleBus::trouble() const {
  if (bus_) return "";
  return "no bus: " + (trouble_.empty() ? "connecting" : trouble_);
}

std::string ConsoleBus::in_one_line() const {
  if (!bus_) return trouble();
  return alarms_.empty() ? "bus " + url_ : alarms_.front();
}

}  // namespace ols::console
