// The bridge's connection to the bus. It passes messages on unchanged, with their signatures, and
// does not verify the signatures. Call send() from any thread.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "base/bus/bus_client.h"
#include "bridge/passage.h"

namespace ols::bridge {

class BridgeBus : public BusClient {
 public:
  // Called in the thread of turn(), with the message's bytes as received.
  using Handler = std::function<void(const std::string& channel, Bytes bytes)>;

  // channels: a regular expression of the channels to receive; empty: nothing is received.
  BridgeBus(std::string url, const std::string& channels, const Handler& handler);

  // Returns false if there is no bus.
  bool send(const std::string& channel, Bytes bytes);

 private:
  std::mutex mutex_;
  std::unique_ptr<LcmBus> sender_;  // under the lock; a second connection, used only to send
};

}  // namespace ols::bridge
