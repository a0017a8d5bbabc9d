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
  // Whether the table of stations is full: then forged statuses may hide real stations.
  bool is_full() const { return statuses_.size() >= wire::kMostStationsHeard; }

  // Those addressed stations that are on the trust list, heard or not; empty where signatures are
  // off.
  std::vector<std::string> enrolled() const;

  // Sends stops repeatedly to the addressed station, or to each as soon as it is heard. A stop
  // needs no status, and may get lost. Ends when all answer that they stand, or after timeout_s.
  // Returns whether each station confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Sends the order and waits for the answer; no status is needed. Returns nullopt if the order was
  // accepted, otherwise why not. Homing takes half a minute: the answer only accepts it, and the
  // status shows its result.
  std::optional<std::string> give(wire::Order order);

  // Turns the unit for that long, then halts it: sends the rate again and again, each time with a
  // lease. Ends at once if the station refuses.
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
  std::map<wire::OrderId, wire::Reply> replies_;  // to this process
  bool stopping_ = false;                         // stops every station that is heard
};

}  // namespace ols::ctl
