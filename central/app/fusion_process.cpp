#include "central/app/fusion_process.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include "base/clocks.h"

namespace ols {
namespace {

constexpr int kWaitMs = 50;
constexpr std::size_t kLatencies = 200;  // for the median in the status
constexpr std::size_t kChannels = 1000;  // with a sequence of their own

}  // namespace

FusionProcess::FusionProcess(const FusionSettings& settings, const FusionProcessOptions& options)
    : settings_(settings),
      options_(options),
      fusion_(settings.fusion),
      connector_(settings.lcm_url),
      present_(settings.slew_clock_tolerance_s),
      others_(options.boot_id),
      status_s_(clock_monotonic_s()) {
  for (const char* name :
       {"targets_withheld", "slews_withheld", "messages_not_sent", "other_fusions"})
    counters_[name] = 0.0;
  for (int i = 0; i <= static_cast<int>(MessageRefusal::kNoPosition); ++i) {
    counters_[to_string(static_cast<MessageRefusal>(i))] = 0.0;
  }
  // Who says that it is ready shall hear what it is told.
  connect(BusConnector::kLongest_s);
}

void FusionProcess::connect(double wait_s) {
  bus_ = connector_.take(clock_monotonic_s(), wait_s);
  std::string why = connector_.trouble();
  try {
    if (bus_ && options_.slew_url != settings_.lcm_url) {
      slew_bus_ = std::make_unique<LcmBus>(options_.slew_url);
    }
  } catch (const BusError& error) {
    bus_.reset();
    why = error.what();
  }
  if (bus_) {
    subscribe();
    if (!trouble_.empty()) spdlog::info("connected to {}", settings_.lcm_url);
    trouble_.clear();
  } else if (!why.empty() && why != trouble_) {
    spdlog::warn("no bus, tried again each second: {}", why);
    trouble_ = why;
  }
}

void FusionProcess::subscribe() {
  bus_->subscribe(std::string(kBearingChannel) + ".*",
                  [this](const BusMessage& message) { on_bearing(message); });
  bus_->subscribe(std::string(kStatusChannel) + ".*",
                  [this](const BusMessage& message) { on_status(message); });
  // A recording has the status of the fusion that it was recorded with.
  if (options_.replay) return;
  bus_->subscribe(std::string(kFusionStatusChannel),
                  [this](const BusMessage& message) { on_fusion_status(message); });
}

void FusionProcess::turn() {
  if (!bus_) connect(0.0);
  if (bus_) {
    bus_->handle(kWaitMs);
    look_at_bus();
  } else {
    std::this_thread::sleep_for(std::chrono::milliseconds(kWaitMs));
  }
  publish_status_when_due();
  // A new connection may do what this one no longer does.
  if (bus_ && (send_failed_ || bus_->is_deaf())) {
    trouble_ = send_failed_ ? "the network takes no messages"
                            : "nothing comes in any more, not even the fusion's own word";
    spdlog::warn("no bus, tried again each second: {}", trouble_);
    bus_.reset();
    slew_bus_.reset();
    watch_.connection_ended();
  }
  send_failed_ = false;
}

void FusionProcess::look_at_bus() {
  const double now_s = clock_monotonic_s();
  watch_.look(bus_->traffic(), now_s);
  const std::string alarm = watch_.alarm(now_s);
  if (!alarm.empty() && bus_alarm_.empty()) spdlog::warn("{}", alarm);
  bus_alarm_ = alarm;
}

template <class Message>
void FusionProcess::send(std::string_view channel, const Message& message) {
  if (bus_ && bus_->publish(std::string(channel), message)) return;
  ++counters_["messages_not_sent"];
  send_failed_ = true;
}

template <class Message>
void FusionProcess::send_slew(const std::string& channel, const Message& message) {
  if (!slew_bus_) return send(channel, message);
  if (slew_bus_->publish(channel, message)) return;
  ++counters_["messages_not_sent"];
  send_failed_ = true;
}

std::string FusionProcess::in_one_line() const {
  if (!bus_) return "no bus: " + trouble_;
  const FusionHealth health = watched_health();
  std::string line = std::to_string(health.stations.size()) + " stations";
  for (const StationHealth& station : health.stations) {
    if (!station.quarantine.empty()) line += "; " + station.station + " quarantined";
  }
  if (!health.alarms.empty()) line += "; " + health.alarms.front();
  const std::string& error = last_error_.empty() ? health.last_error : last_error_;
  if (!error.empty()) line += "; last error: " + error;
  return line;
}

void FusionProcess::on_bearing(const BusMessage& message) {
  const auto decoded = sighting_from(message.channel, message.payload.data(),
                                     static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, message.channel);
  }
  publish(fusion_.add(std::get<Sighting>(decoded)));
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

void FusionProcess::on_fusion_status(const BusMessage& message) {
  const auto boot_id =
      fusion_boot_from(message.payload.data(), static_cast<int>(message.payload.size()));
  if (const auto* refusal = std::get_if<MessageRefusal>(&boot_id)) {
    return refuse(*refusal, std::string(kFusionStatusChannel));
  }
  const double now_s = clock_monotonic_s();
  if (others_.hear(std::get<std::int64_t>(boot_id), now_s)) ++counters_["other_fusions"];
  if (!others_.take_news()) return;
  last_error_ = others_.alarm(now_s);
  spdlog::warn("{}", last_error_);
}

void FusionProcess::refuse(MessageRefusal refusal, const std::string& channel) {
  ++counters_[to_string(refusal)];
  if (refusal == MessageRefusal::kNoPosition) return;  // it will know one day
  last_error_ = channel + ": " + to_string(refusal);
}

MessageStamp FusionProcess::next_stamp(std::string_view channel) {
  const auto [sequence, is_new] = sequences_.try_emplace(std::string(channel), forgotten_sequence_);
  const MessageStamp stamp{options_.boot_id, ++sequence->second};
  if (sequences_.size() > kChannels) forget_sequences();
  return stamp;
}

// Stations come and go, a flood brings any number of names. Each channel's sequence must only grow,
// so that all begin again above the greatest.
void FusionProcess::forget_sequences() {
  for (const auto& [channel, sequence] : sequences_) {
    forgotten_sequence_ = std::max(forgotten_sequence_, sequence);
  }
  sequences_.clear();
}

// What waited for a standing process is still worked off, so that the tracks go on.
bool FusionProcess::is_present(std::int64_t utime_us, const char* counter) {
  if (options_.replay) return true;
  const double now_s = clock_monotonic_s();
  if (present_.passes(utime_us, clock_utime_us(), now_s)) return true;
  ++counters_[counter];
  if (present_.take_news()) {
    last_error_ = present_.alarm(now_s);
    spdlog::warn("{}", last_error_);
  }
  return false;
}

void FusionProcess::publish(const FusionOutput& output) {
  for (const FusedTarget& target : output.targets) {
    if (!is_present(target.utime_us, "targets_withheld")) continue;
    send(kTargetChannel, to_message(target, next_stamp(kTargetChannel)));
    latencies_s_.push_back(static_cast<double>(clock_utime_us() - target.utime_us) * 1e-6);
    if (latencies_s_.size() > kLatencies) latencies_s_.pop_front();
  }
  for (const FusedTarget& target : output.targets_paper) {
    if (!is_present(target.utime_us, "targets_withheld")) continue;
    send(kPaperTargetChannel, to_message(target, next_stamp(kPaperTargetChannel)));
  }
  for (const Slew& slew : output.slews) {
    if (!is_present(slew.utime_us, "slews_withheld")) continue;
    const std::string channel = std::string(kSlewChannel) + slew.station;
    send_slew(channel, to_message(slew, next_stamp(channel)));
  }
}

// By the messages' time, so that a replay at any speed shows the same; by the clock in silence.
void FusionProcess::publish_status_when_due() {
  const double interval_s = settings_.status_interval_s;
  const double now_s = clock_monotonic_s();
  const double by_messages_s = static_cast<double>(fusion_.now_us() - status_message_us_) * 1e-6;
  if (std::abs(by_messages_s) < interval_s && now_s - status_s_ < interval_s) return;
  status_message_us_ = fusion_.now_us();
  status_s_ = now_s;
  FusionHealth health = watched_health();
  health.last_error = newest_error(health.last_error);
  send(kFusionStatusChannel,
       to_message(health, median_latency_s(), next_stamp(kFusionStatusChannel)));
}

// The fusion's own, and what this process sees beside it.
FusionHealth FusionProcess::watched_health() const {
  const double now_s = clock_monotonic_s();
  FusionHealth health = fusion_.health();
  health.counters.insert(counters_.begin(), counters_.end());
  watch_.count(health.counters);
  for (const std::string& alarm :
       {present_.alarm(now_s), others_.alarm(now_s), watch_.alarm(now_s)}) {
    if (!alarm.empty()) health.alarms.insert(health.alarms.begin(), alarm);
  }
  return health;
}

// Of the fusion's last error and this process's the one that is new since the last status.
const std::string& FusionProcess::newest_error(const std::string& of_fusion) {
  const bool untold = last_error_ != told_error_;
  if (of_fusion != fusion_error_ && !untold) last_error_ = of_fusion;
  fusion_error_ = of_fusion;
  told_error_ = last_error_;
  return last_error_;
}

double FusionProcess::median_latency_s() const {
  if (latencies_s_.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(latencies_s_.begin(), latencies_s_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

}  // namespace ols
