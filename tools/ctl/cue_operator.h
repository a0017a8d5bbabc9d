// The operator's side of the bus for cues: receives the fusion's status and sends an operator's
// decisions.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "base/bus/lcm_bus.h"
#include "base/trust/trust_config.h"
#include "ols_msg/target_t.hpp"
#include "tools/ctl/cue_table.h"
#include "wire/fusion_status.h"
#include "wire/orders.h"

namespace ols::ctl {

class CueOperator {
 public:
  // Throws BusError, or ConfigError if it cannot sign.
  CueOperator(const std::string& lcm_url, const trust::TrustConfig& trust);

  // The fusion's next status; nullopt: no status came within this time, so no fusion runs.
  std::optional<ols_msg::fusion_status_t> listen(double timeout_s);
  // The classes of the targets that have been published since this object was constructed.
  const TargetClasses& classes() const { return classes_; }
  // Sends the order and waits for the answer. Returns nullopt if the order was accepted, otherwise
  // why not.
  std::optional<std::string> give(const wire::CueOrder& order, double timeout_s);

 private:
  void note_class(const ols_msg::target_t& target);

  const std::int64_t boot_id_;
  LcmBus bus_;
  wire::OrderSender sender_;
  std::optional<ols_msg::fusion_status_t> said_;
  std::optional<wire::Reply> reply_;
  TargetClasses classes_;
};

}  // namespace ols::ctl
