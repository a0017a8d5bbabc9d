// An LCM connection that says what is wrong instead of going deaf.
//
// LCM's own self test blocks ten seconds when no multicast route exists, and the subscription is
// then dead although the object says good(). Here the route is looked up first.
#pragma once

#include <cstdint>
#include <exception>
#include <functional>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace ols {

class BusError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class LcmBus {
 public:
  // Throws BusError with what to do about it when the URL is malformed or has no multicast route.
  explicit LcmBus(const std::string& url);
  ~LcmBus();

  // Begins to receive; the first subscription does it too. LCM's self test of that takes up to ten
  // seconds: throws BusError when nothing comes back.
  void listen();

  // A raw subscription: the handler decodes, so that what it cannot decode is counted by it.
  using Handler = std::function<void(const std::string& channel, const void* data, int bytes)>;
  void subscribe(const std::string& channel_regex, Handler handler, int queue_capacity = 1000);

  // False when the network takes it no longer.
  template <class Message>
  bool publish(const std::string& channel, const Message& message) {
    return lcm_.publish(channel, &message) == 0;
  }

  // Handles what has arrived, a few hundred messages at most, so that a flood cannot keep the
  // caller; waits at most timeout_ms for the first. Returns the number of messages handled.
  int handle(int timeout_ms);

 private:
  struct Subscriber;
  lcm::LCM lcm_;
  std::vector<std::unique_ptr<Subscriber>> subscribers_;
};

// True when the whole of a datagram is one message of this type. Generated decoders throw on a
// damaged length (std::length_error, std::bad_alloc); that is no message either.
template <class Message>
bool decode_exactly(const void* data, int bytes, Message& message) {
  try {
    return message.decode(data, 0, bytes) == bytes;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace ols
