// ols-bridge on the bus: receives and sends messages unchanged, with their signatures, which it
// does not judge. Sends from any thread.
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

  // channels: a regular expression; empty: it receives nothing.
  BridgeBus(std::string url, const std::string& channels, const Handler& handler);

  // False: there is no bus.
  bool send(const std::string& channel, Bytes bytes);

 private:
  std::mutex mutex_;
  std::unique_ptr<LcmBus> sender_;  // under the lock: a second connection, which receives nothing
};

}  // namespace ols::bridge
