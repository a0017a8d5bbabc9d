// The operator's side of the bus for cues: the fusion's report, and an operator's decision.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/lcm_bus.h"
#include "base/trust/trust_config.h"
#include "command/messages.h"

namespace ols::ctl {

class CueOperator {
 public:
  // Throws BusError, or ConfigError if it cannot sign.
  CueOperator(const std::string& lcm_url, const trust::TrustConfig& trust);

  // The fusion's next status; nullopt within this time: there is no fusion.
  std::optional<command::FusionCues> listen(double timeout_s);
  // Sends the order and waits for the status that shows it. nullopt if it was accepted, otherwise
  // why not.
  std::optional<std::string> give(const command::CueOrder& order, double timeout_s);

 private:
  const std::int64_t boot_id_;
  LcmBus bus_;
  command::OrderSender sender_;
  std::optional<command::FusionCues> said_;
};

}  // namespace ols::ctl
