#include "bridge/bridge_bus.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "bridge/memory_budget.h"
#include "bridge/raw_message.h"

namespace ols::bridge {
namespace {

constexpr QueueLimits kQueue{20'000, kBusQueueBytes};

BusClient::Subscribe hears(const std::string& channels, const BridgeBus::Handler& handler) {
  if (channels.empty()) return {};
  return [channels, handler](LcmBus& bus) {
    const auto pass = [handler](const BusMessage& message) {
      std::vector<std::uint8_t> bytes = message.payload;
      bytes.insert(bytes.end(), message.trailer.begin(), message.trailer.end());
      handler(message.channel, bytes);
    };
    bus.subscribe(channels, pass, kQueue);
  };
}

}  // namespace

BridgeBus::BridgeBus(std::string url, const std::string& channels, const Handler& handler)
    : BusClient(std::move(url), nullptr, hears(channels, handler)) {}

bool BridgeBus::send(const std::string& channel, Bytes bytes) {
  const std::lock_guard lock(mutex_);
  try {
    if (!sender_) sender_ = std::make_unique<LcmBus>(url());
  } catch (const BusError&) {
    return false;  // turn() says why
  }
  if (sender_->publish(channel, RawMessage{bytes})) return true;
  sender_.reset();
  return false;
}

}  // namespace ols::bridge
