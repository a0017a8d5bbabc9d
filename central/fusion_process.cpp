#include "central/fusion_process.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/clocks.h"

namespace ols {
namespace {

constexpr int kWaitMs = 50;
constexpr std::size_t kLatencies = 200;  // for the median in the status

}  // namespace

FusionProcess::FusionProcess(const FusionSettings& settings, const FusionProcessOptions& options)
    : settings_(settings),
      options_(options),
      fusion_(settings.fusion),
      bus_(settings.lcm_url),
      status_s_(clock_monotonic_s()) {
  if (options_.slew_url != settings_.lcm_url) slew_bus_.emplace(options_.slew_url);
  counters_["slews_withheld"] = 0.0;
  for (const auto refusal : {MessageRefusal::kMalformed, MessageRefusal::kSchema,
                             MessageRefusal::kOtherStation, MessageRefusal::kOutOfRange}) {
    counters_[to_string(refusal)] = 0.0;
  }
  bus_.subscribe(std::string(kBearingChannel) + ".*",
                 [this](const std::string& channel, const void* data, int bytes) {
                   on_bearing(channel, data, bytes);
                 });
  bus_.subscribe(std::string(kStatusChannel) + ".*",
                 [this](const std::string& channel, const void* data, int bytes) {
                   on_status(channel, data, bytes);
                 });
}

void FusionProcess::turn() {
  bus_.handle(kWaitMs);
  publish_status_when_due();
}

void FusionProcess::on_bearing(const std::string& channel, const void* data, int bytes) {
  const auto decoded = sighting_from(channel, data, bytes);
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, channel);
  }
  publish(fusion_.add(std::get<Sighting>(decoded)));
}

void FusionProcess::on_status(const std::string& channel, const void* data, int bytes) {
  const auto decoded = station_place_from(channel, data, bytes);
  if (const auto* refusal = std::get_if<MessageRefusal>(&decoded)) {
    return refuse(*refusal, channel);
  }
  const auto& place = std::get<StationPlace>(decoded);
  fusion_.know_station(place.station, place.position_ecef);
}

void FusionProcess::refuse(MessageRefusal refusal, const std::string& channel) {
  ++counters_[to_string(refusal)];
  last_error_ = channel + ": " + to_string(refusal);
}

MessageStamp FusionProcess::next_stamp(std::string_view channel) {
  return {options_.boot_id, ++sequences_[std::string(channel)]};
}

void FusionProcess::publish(const FusionOutput& output) {
  if (output.target) {
    bus_.publish(std::string(kTargetChannel),
                 to_message(*output.target, next_stamp(kTargetChannel)));
    latencies_s_.push_back(static_cast<double>(clock_utime_us() - output.target->utime_us) * 1e-6);
    if (latencies_s_.size() > kLatencies) latencies_s_.pop_front();
  }
  if (output.target_paper) {
    bus_.publish(std::string(kPaperTargetChannel),
                 to_message(*output.target_paper, next_stamp(kPaperTargetChannel)));
  }
  publish_slews(output.slews);
}

void FusionProcess::publish_slews(const std::vector<Slew>& slews) {
  for (const Slew& slew : slews) {
    const double off_s = static_cast<double>(slew.utime_us - clock_utime_us()) * 1e-6;
    if (!options_.replay && std::abs(off_s) > settings_.slew_clock_tolerance_s) {
      ++counters_["slews_withheld"];
      if (!said_withheld_) {
        spdlog::warn(
            "slews withheld: the messages' time is {:.1f} s from this host's clock; "
            "is this a replay? use --replay",
            off_s);
      }
      said_withheld_ = true;
      continue;
    }
    const std::string channel = std::string(kSlewChannel) + slew.station;
    (slew_bus_ ? *slew_bus_ : bus_).publish(channel, to_message(slew, next_stamp(channel)));
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
  FusionHealth health = fusion_.health();
  health.counters.insert(counters_.begin(), counters_.end());
  if (health.last_error.empty()) health.last_error = last_error_;
  bus_.publish(std::string(kFusionStatusChannel),
               to_message(health, median_latency_s(), next_stamp(kFusionStatusChannel)));
}

double FusionProcess::median_latency_s() const {
  if (latencies_s_.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(latencies_s_.begin(), latencies_s_.end());
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::ranges::nth_element(sorted, middle);
  return *middle;
}

}  // namespace ols
