// The operator's side of the bus: sends an order to a station, and reads the outcome from its
// status.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/lcm_bus.h"
#include "command/messages.h"
#include "ols_msg/station_status_t.hpp"

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
  bool is_full() const { return statuses_.size() >= command::kMostStationsHeard; }

  // The addressed stations of the trust list, heard or not; empty where signatures are off.
  std::vector<std::string> enrolled() const;

  // Sends stops repeatedly to the addressed station, or to each station as soon as it is heard,
  // until its status confirms one or timeout_s is over: a stop needs no status, and may get lost.
  // Returns whether each station confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Sends the order and waits for the status that counts it. Returns nullopt if it was accepted,
  // otherwise the station's reason. Homing takes half a minute: only its acceptance is awaited; the
  // status shows its result.
  std::optional<std::string> give(const command::Order& order);

  // Turns the unit for this time, then halts it: sends the rate repeatedly, each with its lease.
  // Returns at once if the station refuses.
  std::optional<std::string> hold_rate(command::Order order, double seconds);

 private:
  void hear(const BusMessage& message);
  void send(const command::Order& order);
  void send_stop(const std::string& station);

  std::string station_;
  const std::int64_t boot_id_;
  const std::shared_ptr<trust::BusTrust> trust_;
  LcmBus bus_;
  Statuses statuses_;
  command::OrderSender sender_;
  bool stopping_ = false;  // every station that is heard
};

}  // namespace ols::ctl
