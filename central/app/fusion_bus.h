// The fusion's connections: to the bus, and to the bus for slews. After a failure, connect() opens
// new connections. Numbers the messages of each channel, and counts the messages that could not be
// sent.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/bus/bus_connector.h"
#include "base/bus/bus_monitor.h"
#include "central/app/messages.h"
#include "conditions/alarm.h"

namespace ols::fusion {

class FusionBus {
 public:
  using Subscribe = std::function<void(LcmBus&)>;
  struct Urls {
    std::string bus, slews;  // may be equal
  };
  // subscribe: called on each new connection. trust: null if messages are neither signed nor
  // verified.
  FusionBus(Urls urls, std::int64_t boot_id, std::shared_ptr<trust::BusTrust> trust,
            Subscribe subscribe);

  // Connects if there is no connection; waits at most wait_s for a network.
  void connect(double wait_s);
  // Handles the messages that have arrived; waits briefly for the first one.
  void handle();
  // Closes a connection that cannot send or does not receive. connect() then opens a new one.
  void end_if_broken();
  template <class Message>
  void send(std::string_view channel, const Message& message) {
    if (!bus_ || !bus_->publish(std::string(channel), message)) note_not_sent();
  }
  template <class Message>
  void send_slew(const std::string& channel, const Message& message) {
    if (!slew_bus_) return send(channel, message);
    if (!slew_bus_->publish(channel, message)) note_not_sent();
  }
  MessageStamp next_stamp(std::string_view channel);

  bool is_connected() const { return bus_ != nullptr; }
  const std::string& trouble() const { return trouble_; }
  // Alarms about the traffic.
  std::vector<Alarm> alarms() const;
  void count(std::map<std::string, double>& counters) const;

 private:
  void note_not_sent();
  void forget_sequences();

  Urls urls_;
  std::int64_t boot_id_;
  std::shared_ptr<trust::BusTrust> trust_;
  Subscribe subscribe_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;       // null while there is no network
  std::unique_ptr<LcmBus> slew_bus_;  // null if slews use bus_
  BusMonitor monitor_;
  std::string trouble_;  // why there is no connection, as text
  bool send_failed_ = false;
  std::int64_t not_sent_ = 0;
  std::map<std::string, std::int64_t, std::less<>> sequences_;
  std::int64_t forgotten_sequence_ = 0;  // the largest sequence number of a forgotten channel
};

}  // namespace ols::fusion
