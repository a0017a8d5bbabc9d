#include "central/app/fusion_process.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "conditions/alarms.h"
#include "conditions/refusal.h"
#include "wire/cue_values.h"

namespace ols::fusion {
namespace {

// The signatures of a recording are too old to be accepted here: `ols-key verify` verifies them.
std::shared_ptr<trust::BusTrust> open_trust(const FusionSettings& settings,
                                            const FusionProcessOptions& options) {
  if (options.replay) return nullptr;
  trust::Self self;
  self.name = "fusion";
  self.boot_id = options.boot_id;
  self.tells_list = self.keeps_marks = true;
  self.list_taken = [](const trust::TrustList& list) {
    write_to_journal({.text = list.in_one_line() + "; taken", .id = event::kTrustList});
  };
  return trust::BusTrust::open(settings.trust, trust::process_environment(), self);
}

}  // namespace

FusionProcess::FusionProcess(const FusionSettings& settings, const FusionProcessOptions& options)
    : settings_(settings),
      options_(options),
      fusion_(settings.fusion),
      bus_({settings.lcm_url, options.slew_url}, options.boot_id, open_trust(settings, options),
           [this](LcmBus& bus) { subscribe(bus); }),
      present_(settings.slew_clock_tolerance_s),
      others_(options.boot_id),
      status_s_(clock_monotonic_s()) {
  for (const char* name : {"targets_withheld", "slews_withheld", "other_fusions"}) {
    counters_[name] = 0.0;
  }
  for (int i = 0; i <= static_cast<int>(MessageRefusal::kNoPosition); ++i) {
    counters_[to_string(static_cast<MessageRefusal>(i))] = 0.0;
  }
  // "Ready" means that the subscriptions are active: a message sent after it is received.
  bus_.connect(BusConnector::kLongest_s);
}

void FusionProcess::subscribe(LcmBus& bus) {
  bus.subscribe(std::string(kBearingChannel) + ".*",
                [this](const BusMessage& message) { on_bearing(message); });
  bus.subscribe(std::string(kStatusChannel) + ".*",
                [this](const BusMessage& message) { on_status(message); });
  bus.subscribe(std::string(kSkylineChannel) + ".*",
                [this](const BusMessage& message) { on_skyline(message); });
  bus.subscribe(std::string(kCueChannel), [this](const BusMessage& message) { on_cue(message); });
  bus.subscribe(std::string(kCueOrderChannel),
                [this](const BusMessage& message) { on_cue_order(message); });
  // A recording has statuses of the fusion that ran at the time. That is no second fusion.
  if (options_.replay) return;
  bus.subscribe(std::string(kFusionStatusChannel),
                [this](const BusMessage& message) { on_fusion_status(message); });
}

void FusionProcess::turn() {
  bus_.connect(0.0);
  bus_.handle();
  publish_status_when_due();
  bus_.end_if_broken();
}

std::string FusionProcess::in_one_line() const {
  if (!bus_.is_connected()) return alarm::no_bus(bus_.trouble());
  const FusionHealth health = watched_health();
  std::string line = std::to_string(health.stations.size()) + " stations";
  for (const StationHealth& station : health.stations) {
    if (!station.quarantine.empty()) line += "; " + station.station + " quarantined";
  }
  if (!health.alarms.empty()) line += "; " + health.alarms.front().text;
  const std::string& error = errors_.last.empty() ? health.last_error : errors_.last;
  if (!error.empty()) line += "; last error: " + error;
  return line;
}

void FusionProcess::on_bearing(const BusMessage& message) {
  const auto decoded = measurement_from(message.channel, message.payload.data(),
                                        static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  waited_s_ = static_cast<double>(clock_utime_us() - message.received_utime_us) * 1e-6;
  publish(fusion_.add(std::get<BearingMeasurement>(decoded)));
}

void FusionProcess::on_status(const BusMessage& message) {
  const auto decoded = station_place_from(message.channel, message.payload.data(),
                                          static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  const auto& place = std::get<StationPlace>(decoded);
  if (!place.no_place) return fusion_.know_station(place.station, place.traits);
  fusion_.allow_slews(place.station, place.traits.commandable);
  refuse(*place.no_place, message.channel);
}

void FusionProcess::on_skyline(const BusMessage& message) {
  const auto decoded = skyline_sector_from(message.channel, message.payload.data(),
                                           static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  fusion_.know_skyline(std::get<SkylineSector>(decoded));
}

void FusionProcess::on_fusion_status(const BusMessage& message) {
  const auto boot_id =
      fusion_boot_from(message.payload.data(), static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&boot_id)) {
    return refuse(*refusal, std::string(kFusionStatusChannel));
  }
  const double now_s = clock_monotonic_s();
  if (others_.hear(std::get<std::int64_t>(boot_id), now_s)) ++counters_["other_fusions"];
  if (!others_.take_event()) return;
  errors_.last = others_.alarm(now_s);
}

// In a replay, the present is the time of the messages.
std::int64_t FusionProcess::present_us() const {
  return options_.replay ? std::max(cue_message_us_, fusion_.now_us()) : clock_utime_us();
}

void FusionProcess::on_cue(const BusMessage& message) {
  const auto decoded = cue_from(message.payload.data(), static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  const Cue& cue = std::get<Cue>(decoded);
  cue_message_us_ = std::clamp(cue.utime_us, std::int64_t{0}, kGreatestUtime);
  waited_s_ = static_cast<double>(clock_utime_us() - message.received_utime_us) * 1e-6;
  publish(fusion_.add(cue, options_.replay ? cue.utime_us : clock_utime_us()));
}

void FusionProcess::on_cue_order(const BusMessage& message) {
  const auto decoded =
      cue_order_from(message.payload.data(), static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  const auto& order = std::get<CueOrder>(decoded);
  bus_.send(kCueReplyChannel, to_message({order.boot_id, order.sequence, obey(order)},
                                         bus_.next_stamp(kCueReplyChannel), clock_utime_us()));
}

// Each order counts once and only while it is fresh, so that replaying it has no effect.
std::string FusionProcess::obey(const CueOrder& order) {
  constexpr double kLongestLease_s = 5.0;
  const double age_s =
      1e-6 * (static_cast<double>(clock_utime_us()) - static_cast<double>(order.utime_us));
  const bool is_fresh =
      options_.replay || std::abs(age_s) <= std::min(order.lease_s, kLongestLease_s);
  const auto last = cue_orders_.find(order.boot_id);
  const bool is_new = last == cue_orders_.end() || order.sequence > last->second;
  if (!is_fresh || !is_new) {
    refuse(MessageRefusal::kOutOfRange, std::string(kCueOrderChannel));
    return is_fresh ? "replayed" : "stale";
  }
  constexpr std::size_t kSenders = 1000;  // forged messages may name any number of senders
  if (cue_orders_.size() >= kSenders) cue_orders_.clear();
  cue_orders_[order.boot_id] = order.sequence;
  if (order.handover) {
    write_to_journal({.text = "hand-over: an operator sets it to " + to_string(*order.handover),
                      .id = event::kCueOrder});
    fusion_.set_handover(*order.handover);
    return {};
  }
  const bool is_target = target_named(order.cue).has_value();
  write_to_journal({.text = (is_target ? "target " : "cue ") + order.cue + ": an operator " +
                            (order.allow ? "allows"
                             : is_target ? "dismisses"
                                         : "forbids") +
                            " it",
                    .id = event::kCueOrder});
  if (fusion_.allow_cue(order.cue, order.allow)) return {};
  if (is_target) {
    return fusion_.handover() == HandoverMode::kOff ? "handover_off" : "no_target";
  }
  return settings_.fusion.cues.allow == CueAllowance::kNever ? "cues_not_allowed" : "no_cue";
}

void FusionProcess::refuse(MessageRefusal refusal, const std::string& channel) {
  ++counters_[to_string(refusal)];
  if (refusal == MessageRefusal::kNoPosition)
    return;  // not an error: it may get its position later
  errors_.last = channel + ": " + refusal_words(to_string(refusal));
}

// Messages that queued up while the process was suspended are still processed, so that the tracks
// continue.
bool FusionProcess::is_present(std::int64_t utime_us, const char* counter) {
  if (options_.replay) return true;
  const double now_s = clock_monotonic_s();
  if (present_.passes(utime_us, clock_utime_us(), now_s, waited_s_)) return true;
  ++counters_[counter];
  if (present_.take_event()) errors_.last = present_.alarm(now_s);
  return false;
}

void FusionProcess::publish(const FusionOutput& output) {
  for (const FusedTarget& target : output.targets) {
    if (!is_present(target.utime_us, "targets_withheld")) continue;
    bus_.send(kTargetChannel, to_message(target, bus_.next_stamp(kTargetChannel)));
    latency_.add(static_cast<double>(clock_utime_us() - target.utime_us) * 1e-6);
  }
  for (const FusedTarget& target : output.targets_paper) {
    if (!is_present(target.utime_us, "targets_withheld")) continue;
    bus_.send(kPaperTargetChannel, to_message(target, bus_.next_stamp(kPaperTargetChannel)));
  }
  publish(output.slews);
  for (const OcclusionNotice& notice : output.occlusions) {
    if (!is_present(notice.utime_us, "slews_withheld")) continue;
    const std::string channel = std::string(kOcclusionChannel) + notice.station;
    bus_.send_slew(channel, to_message(notice, bus_.next_stamp(channel)));
  }
}

void FusionProcess::publish(const std::vector<Slew>& slews) {
  for (const Slew& slew : slews) {
    if (!is_present(slew.utime_us, "slews_withheld")) continue;
    const std::string channel = std::string(kSlewChannel) + slew.station;
    bus_.send_slew(channel, to_message(slew, bus_.next_stamp(channel)));
  }
}

// Due by message time, so that replays at any speed give the same output; by host time if no
// messages arrive.
void FusionProcess::publish_status_when_due() {
  const double interval_s = settings_.status_interval_s;
  const double now_s = clock_monotonic_s();
  const double by_messages_s = static_cast<double>(fusion_.now_us() - status_message_us_) * 1e-6;
  if (std::abs(by_messages_s) < interval_s && now_s - status_s_ < interval_s) return;
  const bool is_silent = fusion_.now_us() == status_message_us_;
  status_message_us_ = fusion_.now_us();
  status_s_ = now_s;
  fusion_.end_silent_cues(present_us());
  FusionHealth health = watched_health();
  health.last_error = errors_.newest(health.last_error);
  alarms_.look(health.alarms, now_s);
  // Without bearings, message time stands still. On a signed bus, receivers reject an old time.
  if (is_silent) health.now_us = present_us();
  bus_.send(kFusionStatusChannel,
            to_message(health, latency_.median_s(), bus_.next_stamp(kFusionStatusChannel)));
}

// The fusion's own alarms, and those of this process.
FusionHealth FusionProcess::watched_health() const {
  const double now_s = clock_monotonic_s();
  FusionHealth health = fusion_.health(present_us());
  health.counters.insert(counters_.begin(), counters_.end());
  bus_.count(health.counters);
  std::vector<Alarm> alarms{present_.alarm(now_s), others_.alarm(now_s)};
  std::ranges::move(bus_.alarms(), std::back_inserter(alarms));
  for (const Alarm& alarm : alarms) {
    if (!alarm.empty()) health.alarms.insert(health.alarms.begin(), alarm);
  }
  return health;
}

const std::string& FusionProcess::Errors::newest(const std::string& of_fusion_now) {
  const bool undeclared = last != told;
  if (of_fusion_now != of_fusion && !undeclared) last = of_fusion_now;
  of_fusion = of_fusion_now;
  told = last;
  return last;
}

void FusionProcess::Latency::add(double latency_s) {
  constexpr std::size_t kLatencies = 200;
  lately_s.push_back(latency_s);
  if (lately_s.size() > kLatencies) lately_s.pop_front();
}

double FusionProcess::Latency::median_s() const {
  if (lately_s.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(lately_s.begin(), lately_s.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

}  // namespace ols::fusion
