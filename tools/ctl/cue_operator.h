// The operator's side of the bus for cues: the fusion's report, and an operator's decision.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/bus/lcm_bus.h"
#include "base/trust/trust_config.h"
#include "wire/fusion_status.h"
#include "wire/orders.h"

namespace ols::ctl {

class CueOperator {
 public:
  // Throws BusError, or ConfigError if it cannot sign.
  CueOperator(const std::string& lcm_url, const trust::TrustConfig& trust);

  // The fusion's next status; nothing within this time: there is no fusion.
  std::optional<ols_msg::fusion_status_t> listen(double timeout_s);
  // Waits for the answer. Nothing if it was taken, otherwise why not.
  std::optional<std::string> give(const wire::CueOrder& order, double timeout_s);

 private:
  const std::int64_t boot_id_;
  LcmBus bus_;
  wire::OrderSender sender_;
  std::optional<ols_msg::fusion_status_t> said_;
  std::optional<wire::Reply> reply_;
};

}  // namespace ols::ctl
