#include "central/app/fusion_bus.h"

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "base/journal/journal.h"
#include "base/process/clocks.h"

namespace ols::fusion {
namespace {

constexpr int kWaitMs = 50;
constexpr std::size_t kChannels = 1000;  // max number with a sequence of their own

}  // namespace

FusionBus::FusionBus(Urls urls, std::int64_t boot_id, std::shared_ptr<trust::BusTrust> trust,
                     Subscribe subscribe)
    : urls_(std::move(urls)),
      boot_id_(boot_id),
      trust_(std::move(trust)),
      subscribe_(std::move(subscribe)),
      connector_(urls_.bus, trust_) {}

void FusionBus::connect(double wait_s) {
  if (bus_) return;
  bus_ = connector_.take(clock_monotonic_s(), wait_s);
  std::string why = connector_.trouble();
  try {
    if (bus_ && urls_.slews != urls_.bus) slew_bus_ = std::make_unique<LcmBus>(urls_.slews, trust_);
  } catch (const BusError& error) {
    bus_.reset();
    why = error.what();
  }
  if (bus_) {
    subscribe_(*bus_);
    if (!trouble_.empty()) write_to_journal(bus_connected_event(urls_.bus));
    trouble_.clear();
  } else if (!why.empty() && why != trouble_) {
    write_to_journal(bus_lost_event(why));
    trouble_ = why;
  }
}

void FusionBus::handle() {
  if (!bus_) {
    std::this_thread::sleep_for(std::chrono::milliseconds(kWaitMs));
    return;
  }
  bus_->handle(kWaitMs);
  monitor_.look(bus_->traffic(), clock_monotonic_s());
}

void FusionBus::end_if_broken() {
  if (bus_ && (send_failed_ || bus_->is_deaf())) {
    trouble_ = send_failed_ ? "sending fails: the network is down"
                            : "no messages arrive any more, not even this program's own";
    write_to_journal(bus_lost_event(trouble_));
    bus_.reset();
    slew_bus_.reset();
    monitor_.connection_ended();
  }
  send_failed_ = false;
}

void FusionBus::note_not_sent() {
  ++not_sent_;
  send_failed_ = true;
}

MessageStamp FusionBus::next_stamp(std::string_view channel) {
  const auto [sequence, is_new] = sequences_.try_emplace(std::string(channel), forgotten_sequence_);
  const MessageStamp stamp{boot_id_, ++sequence->second};
  if (sequences_.size() > kChannels) forget_sequences();
  return stamp;
}

// Stations come and go, and a flood brings any number of names. Each channel's sequence must only
// grow, so a forgotten channel continues above the largest one.
void FusionBus::forget_sequences() {
  for (const auto& [channel, sequence] : sequences_) {
    forgotten_sequence_ = std::max(forgotten_sequence_, sequence);
  }
  sequences_.clear();
}

std::vector<Alarm> FusionBus::alarms() const { return monitor_.alarms(clock_monotonic_s()); }

void FusionBus::count(std::map<std::string, double>& counters) const {
  counters["messages_not_sent"] = static_cast<double>(not_sent_);
  monitor_.count(counters);
}

}  // namespace ols::fusion
