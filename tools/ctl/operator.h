// The operator's side of the bus: sends an order to a station and waits for the answer.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/bus/lcm_bus.h"
#include "ols_msg/station_status_t.hpp"
#include "wire/orders.h"
#include "wire/station_status.h"

namespace ols::ctl {

// An operator's signature. Throws ConfigError.
std::shared_ptr<trust::BusTrust> open_operator_trust(const trust::TrustConfig& config,
                                                     std::int64_t boot_id);

class Operator {
 public:
  using Statuses = std::map<std::string, ols_msg::station_status_t>;

  // `station` or "all". Throws BusError, or ConfigError if it cannot sign.
  Operator(const std::string& lcm_url, const trust::TrustConfig& trust, std::string station);

  // Listens, and returns the newest status of each addressed station. For one named station: until
  // its status arrives, at most timeout_s. For all: two status intervals.
  const Statuses& listen(double timeout_s);
  // The table of stations is full: forged statuses may hide real stations.
  bool is_full() const { return statuses_.size() >= wire::kMostStationsHeard; }

  // The addressed stations of the trust list, heard or not; empty where signatures are off.
  std::vector<std::string> enrolled() const;

  // Sends stops repeatedly to the addressed station, or to each as soon as it is heard, until it
  // answers that it stands or timeout_s is over: a stop needs no status, and may get lost. Returns
  // whether each station confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Sends the order and waits for the answer; no status is needed. Returns nullopt if it was
  // accepted, otherwise why not. Homing: acceptance only, it takes half a minute; the status shows
  // its result.
  std::optional<std::string> give(wire::Order order);

  // Turns the unit for so long, then halts it: sends the rate again and again, each with its lease.
  // Ends at once with the station's refusal.
  std::optional<std::string> hold_rate(wire::Order order, double seconds);

 private:
  void hear(const BusMessage& message);
  // Under an id of its own.
  wire::OrderId send(wire::Order order);
  std::optional<wire::Reply> wait_for_reply(wire::OrderId order);
  void send_stop(const std::string& station);

  std::string station_;
  const std::int64_t boot_id_;
  const std::shared_ptr<trust::BusTrust> trust_;
  LcmBus bus_;
  Statuses statuses_;
  wire::OrderSender sender_;
  std::map<wire::OrderId, wire::Reply> replies_;  // to this process
  bool stopping_ = false;                         // every station that is heard
};

}  // namespace ols::ctl
