#include "console/console_bus.h"

#include "base/bus/boot_id.h"
#include "base/bus/channel_names.h"
#include "conditions/alarms.h"
#include "conditions/sayings.h"
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
  self.commands = self.tells_list = self.keeps_marks = true;
  return trust::BusTrust::open(config, trust::process_environment(), self);
}

}  // namespace

ConsoleBus::ConsoleBus(const std::string& url, const trust::TrustConfig& trust, Console& console)
    : console_(console),
      boot_id_(draw_boot_id()),
      client_(
          url, open_trust(trust, boot_id_), [this](LcmBus& bus) { subscribe(bus); },
          [this](const std::string& trouble) { note_trouble(trouble); }),
      sender_(boot_id_),
      answer_sender_(boot_id_),
      incident_sender_(boot_id_) {}

void ConsoleBus::subscribe(LcmBus& bus) {
  bus.subscribe(station_channel(kStatusChannel, ".+"), [this](const BusMessage& message) {
    if (auto heard = station_from(message)) console_.receive(*heard, now_);
  });
  bus.subscribe(station_channel(kBearingChannel, ".+"), [this](const BusMessage& message) {
    if (auto heard = bearing_from(message)) console_.receive_bearing(heard->first, heard->second);
  });
  bus.subscribe(std::string(kTargetChannel), [this](const BusMessage& message) {
    if (auto heard = target_from(message)) console_.receive(*heard, now_);
  });
  bus.subscribe(station_channel(kOcclusionChannel, ".+"), [this](const BusMessage& message) {
    if (const auto heard = occlusion_from(message)) console_.receive(*heard, now_);
  });
  bus.subscribe(station_channel(kSkylineChannel, ".+"), [this](const BusMessage& message) {
    if (const auto heard = skyline_from(message)) console_.receive(*heard);
  });
  bus.subscribe(std::string(kFusionStatusChannel), [this](const BusMessage& message) {
    if (auto heard = fusion_from(message)) console_.receive(*heard, now_);
  });
  for (const std::string& channel :
       {station_channel(kReplyChannel, ".+"), std::string(kCueReplyChannel)}) {
    bus.subscribe(channel, [this](const BusMessage& message) {
      auto reply = wire::decode_reply(message);
      if (!reply || reply->order.boot_id != boot_id_) return;
      reply->order.boot_id = 0;  // as the console numbers its orders
      console_.receive(*reply);
    });
  }
  bus.subscribe(
      station_channel(kPreviewChannel, ".+"),
      [this](const BusMessage& message) {
        if (auto heard = picture_from(message)) console_.receive(std::move(*heard));
      },
      kPictureLimits);
  bus.subscribe(
      station_channel(kProcedureChannel, ".+"),
      [this](const BusMessage& message) {
        if (auto heard = procedure_from(message)) console_.receive(std::move(*heard));
      },
      kPictureLimits);
}

void ConsoleBus::note_trouble(const std::string& trouble) {
  console_.note("", trouble.empty() ? note::bus_is_back() : alarm::no_bus(trouble), now_);
}

void ConsoleBus::turn(const Now& now) {
  now_ = now;
  if (client_.bus() == nullptr) return client_.connect(now.monotonic_s, 0.0);
  client_.handle(now.monotonic_s, 0);
  note_alarms();
  if (!send_failed_) return client_.end_if_deaf();
  client_.end("sending fails: the network is down");
  send_failed_ = false;
}

void ConsoleBus::note_alarms() {
  alarms_ = client_.alarms(now_.monotonic_s);
  console_.receive_own(alarms_, now_);
}

void ConsoleBus::send(const std::vector<wire::Order>& orders, const Now& now) {
  if (client_.bus() == nullptr) return;
  for (const wire::Order& order : orders) {
    if (!sender_.send(*client_.bus(), order, now.utime_us)) send_failed_ = true;
  }
}

void ConsoleBus::send(const std::vector<ProcedureAnswer>& answers, const Now& now) {
  if (client_.bus() == nullptr) return;
  for (const ProcedureAnswer& answer : answers) {
    if (!answer_sender_.send(*client_.bus(), answer, now.utime_us)) send_failed_ = true;
  }
}

void ConsoleBus::send(const std::vector<wire::CueOrder>& orders, const Now& now) {
  if (client_.bus() == nullptr) return;
  for (const wire::CueOrder& order : orders) {
    if (!sender_.send(*client_.bus(), order, now.utime_us)) send_failed_ = true;
  }
}

void ConsoleBus::send(const IncidentBook::News& news, const Now& now) {
  if (client_.bus() == nullptr) return;
  const IncidentWatch& watch = console_.incidents().watch();
  if (!incident_sender_.send(*client_.bus(), watch, news, now.utime_us)) send_failed_ = true;
}

std::string ConsoleBus::in_one_line() const {
  if (client_.bus() == nullptr) return trouble();
  return alarms_.empty() ? "bus " + client_.url() : alarms_.front().text;
}

}  // namespace ols::console
