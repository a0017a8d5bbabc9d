// The operator's side of the bus: sends an order to a station and reads the outcome from its
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

  // Listens and returns the newest status of each addressed station. One named station: until its
  // status arrives, at most timeout_s; all: for two status intervals.
  const Statuses& listen(double timeout_s);
  // The table of stations is full: forged statuses may hide real stations.
  bool is_full() const { return statuses_.size() >= command::kMostStationsHeard; }

  // Those that are addressed, of the trust list, heard or not; none where signatures are off.
  std::vector<std::string> enrolled() const;

  // Sends stops repeatedly to the addressed station, or to each as soon as it is heard, until its
  // status confirms one or timeout_s is over: a stop needs no status, and may get lost. Returns
  // whether each station confirmed.
  std::map<std::string, bool> stop(double timeout_s);

  // Sends the order and waits for the status that counts it. Returns nothing if it was accepted,
  // otherwise the station's reason. Homing: acceptance only, it takes half a minute; the status
  // shows its result.
  std::optional<std::string> give(const command::Order& order);

  // Turns the unit for so long, then halts it: sends the rate again and again, each with its lease.
  // Ends at once with the station's refusal.
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
