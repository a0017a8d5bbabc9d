// A connection to the bus: LCM messages over UDP multicast, or within one process. The project
// parses datagrams itself (bus_datagram.h says why); LCM provides the types, the wire format and
// the logs. Unless `trust` is null, the connection signs what the process sends, and verifies what
// it receives (base/trust/bus_trust.h).
#pragma once

#include <cstdint>
#include <exception>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "base/bus/bus_inbox.h"
#include "base/bus/multicast_socket.h"
#include "base/process/wakeup.h"

namespace ols {

class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class LcmBus {
 public:
  using Handler = BusInbox::Handler;
  using Express = BusInbox::Express;

  // Throws BusError, with advice, if the URL is malformed or there is no multicast route. trust:
  // shared by all connections of the process; null: nothing is signed or verified.
  explicit LcmBus(const std::string& url, std::shared_ptr<trust::BusTrust> trust = {});
  ~LcmBus();

  // Starts to receive; the first subscription does so, too. Throws BusError if this connection does
  // not receive its own self-test message within kSelfTest_s.
  void listen();
  static constexpr double kSelfTest_s = 3.0;

  // The handler decodes the message, and counts undecodable ones.
  void subscribe(const std::string& channel_regex, Handler handler, QueueLimits limits = {},
                 Express express = {});

  // False if sending fails because the network is down. A message that is too large for a datagram
  // is only counted (BusTraffic::unsendable); then the result is true.
  template <class Message>
  bool publish(const std::string& channel, const Message& message) {
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
    const int size = static_cast<int>(bytes.size());
    if (message.encode(bytes.data(), 0, size) == size) return send(channel, bytes);
    ++unsendable_;
    return true;
  }

  // Handles the messages that have arrived; waits at most timeout_ms for the first. Handles a few
  // hundred at most, so that a flood cannot keep the caller busy. Returns the number of messages
  // handled.
  int handle(int timeout_ms);

  // Stops receiving. Queued messages can still be handled. A later subscription starts again.
  void stop_listening();

  // True if nothing has arrived for some seconds, not even this connection's own self-test. An
  // interface that disappears takes the group membership with it, without an error. The connection
  // then receives nothing more. To receive again, make a new connection.
  bool is_deaf() const { return unanswered_ >= kUnanswered; }

  BusTraffic traffic() const;

 private:
  bool send(const std::string& channel, std::span<const std::uint8_t> payload);
  void receive_until_ended();
  void hear_oneself();
  void send_self_test();
  void check_hearing();
  void tell_what_is_signed();

  std::string url_;
  std::shared_ptr<trust::BusTrust> trust_;
  class InProcess;                           // all connections of this process to one bus
                                             // memq://NAME
  std::unique_ptr<MulticastSocket> socket_;  // null: the bus is within this process
  BusInbox inbox_;
  std::shared_ptr<InProcess> others_;  // null unless the bus is memq://NAME
  std::uint32_t sequence_ = 0;
  std::uint64_t unsendable_ = 0;
  Wakeup end_;
  std::thread receiver_;  // shares only the inbox with other threads
  static constexpr double kCheck_s = 2.0;
  static constexpr int kUnanswered = 2;  // deaf after this many self-tests in a row that did not
                                         // come back
  double checked_s_ = 0.0;
  std::uint64_t received_ = 0;  // messages received until the last check
  bool tested_ = false;         // whether the last check sent a self-test
  int unanswered_ = 0;
};

// True if the whole datagram is one message of this type. Generated decoders throw on a damaged
// length (std::length_error, std::bad_alloc); the result is then false.
template <class Message>
bool decode_exactly(const void* data, int bytes, Message& message) {
  try {
    return message.decode(data, 0, bytes) == bytes;
  } catch (const std::exception&) {
    return false;
  }
}

template <class Message>
bool decode_exactly(const BusMessage& received, Message& message) {
  return decode_exactly(received.payload.data(), static_cast<int>(received.payload.size()),
                        message);
}

// As decode_exactly(); also false if this program does not know the message's schema number.
template <class Message>
bool decode_of_schema(const BusMessage& received, Message& message) {
  return decode_exactly(received, message) && message.schema_version == Message::SCHEMA_VERSION;
}

}  // namespace ols
