// The fusion's networks: the bus, and where slews go. Without a network it waits for one. Numbers
// the messages of each channel, and counts what was not sent.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "base/bus_connector.h"
#include "base/bus_monitor.h"
#include "central/app/messages.h"

namespace ols::fusion {

class FusionBus {
 public:
  using Subscribe = std::function<void(LcmBus&)>;
  // subscribe: on each new connection. slew_url: may be the same.
  FusionBus(const std::string& url, const std::string& slew_url, std::int64_t boot_id,
            Subscribe subscribe);

  // Waits so long for a network, where there is none.
  void connect(double wait_s);
  // Handles what has arrived, waiting a little for the first message.
  void handle();
  // Ends a connection that sends no more, or on which nothing comes in: a new one may.
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
  // In words, what is wrong with the traffic; empty: nothing.
  std::string alarm() const;
  void count(std::map<std::string, double>& counters) const;

 private:
  void note_not_sent();
  void forget_sequences();

  std::string url_, slew_url_;
  std::int64_t boot_id_;
  Subscribe subscribe_;
  BusConnector connector_;
  std::unique_ptr<LcmBus> bus_;       // nothing: no network
  std::unique_ptr<LcmBus> slew_bus_;  // nothing: slews go on the same bus
  BusMonitor watch_;
  std::string alarm_;    // the last one
  std::string trouble_;  // of the network
  bool send_failed_ = false;
  std::int64_t not_sent_ = 0;
  std::map<std::string, std::int64_t, std::less<>> sequences_;
  std::int64_t forgotten_sequence_ = 0;  // the greatest of a channel that was forgotten
};

}  // namespace ols::fusion
