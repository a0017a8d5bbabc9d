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

// Opens the keys with which an operator signs. Throws ConfigError.
std::shared_ptr<trust::BusTrust> open_operator_trust(const trust::TrustConfig& config,
                                                     std::int64_t boot_id);

class Operator {
 public:
  using Statuses = std::map<std::string, ols_msg::station_status_t>;

  // `station` or "all". Throws BusError, or ConfigError if it cannot sign.
  Operator(const std::string& lcm_url, const trust::TrustConfig& trust, std::string station);

  // Listens, and returns the newest status of each addressed station. Listens for two status
  // intervals if all stations are addressed, otherwise until the station's status arrives, at most
  // `timeout_s`.
  const Statuses& listen(double timeout_s);
  // Whether the table of stations is full: then forged statuses may hide real stations.
  bool is_full() const { return statuses_.size() >= wire::kMostStationsHeard; }

  // The addressed stations that are on the trust list, whether or not a status has come from them;
  // empty if signatures are off.
  std::vector<std::string> enrolled() const;

  // Sends stops repeatedly, because a stop may get lost. With "all", sends them to each station as
  // soon as its status arrives; a named station needs no status. Ends when all stations have
  // confirmed that they are stopped, or after `timeout_s`. Returns which stations have confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Sends the order and waits for the answer; no status is needed. Returns nullopt if the order was
  // accepted, otherwise why not. Homing takes half a minute: the answer says only that it was
  // accepted, and the status later shows the result.
  std::optional<std::string> give(wire::Order order);

  // Turns the unit at a rate for this time, then halts it. Sends the rate repeatedly, each time
  // with a lease. Ends immediately if the station refuses.
  std::optional<std::string> hold_rate(wire::Order order, double seconds);

 private:
  void receive(const BusMessage& message);
  // Sends the order with a new id.
  wire::OrderId send(wire::Order order);
  std::optional<wire::Reply> wait_for_reply(wire::OrderId order);
  void send_stop(const std::string& station);

  std::string station_;
  const std::int64_t boot_id_;
  const std::shared_ptr<trust::BusTrust> trust_;
  LcmBus bus_;
  Statuses statuses_;
  wire::OrderSender sender_;
  std::map<wire::OrderId, wire::Reply> replies_;  // replies to the orders of this process
  bool stopping_ = false;  // while true, stops every station whose status arrives
};

}  // namespace ols::ctl
