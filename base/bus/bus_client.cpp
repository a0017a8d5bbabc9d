#include "base/bus/bus_client.h"

#include <chrono>
#include <thread>
#include <utility>

#include "base/journal/journal.h"
#include "conditions/alarms.h"

namespace ols {

BusClient::BusClient(std::string url, std::shared_ptr<trust::BusTrust> trust, Subscribe subscribe,
                     Tell tell)
    : url_(std::move(url)),
      subscribe_(std::move(subscribe)),
      tell_(std::move(tell)),
      connector_(url_, std::move(trust)) {}

void BusClient::say(const std::string& why) {
  trouble_ = why;
  write_to_journal(bus_lost_event(why));
  if (tell_) tell_(why);
}

void BusClient::connect(double now_s, double wait_s) {
  bus_ = connector_.take(now_s, wait_s);
  if (!bus_) {
    const std::string& why = connector_.trouble();
    if (!why.empty() && why != trouble_) say(why);
    return;
  }
  if (subscribe_) subscribe_(*bus_);
  if (tell_ && !trouble_.empty()) tell_("");
  trouble_.clear();
  write_to_journal(bus_connected_event(url_));
}

void BusClient::end(const std::string& why) {
  say(why);
  bus_.reset();
  monitor_.connection_ended();
}

void BusClient::handle(double now_s, int wait_ms) {
  bus_->handle(wait_ms);
  monitor_.look(bus_->traffic(), now_s);
}

void BusClient::end_if_deaf() {
  if (bus_->is_deaf()) end("no messages arrive any more, not even this program's own");
}

void BusClient::turn(double now_s, int wait_ms) {
  if (!bus_) {
    connect(now_s, 0.0);
    if (!bus_) std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    return;
  }
  handle(now_s, wait_ms);
  end_if_deaf();
}

Alarm BusClient::trouble() const {
  if (bus_) return {};
  return alarm::no_bus(trouble_.empty() ? "connecting" : trouble_);
}

std::vector<Alarm> BusClient::all_alarms(double now_s) const {
  std::vector<Alarm> all = alarms(now_s);
  if (!bus_) all.insert(all.begin(), trouble());
  return all;
}

}  // namespace ols
