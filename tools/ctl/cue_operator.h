// The operator's side of the bus for cues: receives the fusion's report, sends an operator's
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

  // The fusion's next status; nullopt: none came within this time, so there is no fusion.
  std::optional<ols_msg::fusion_status_t> listen(double timeout_s);
  // The classes of the targets that were published since this object was made.
  const TargetClasses& classes() const { return classes_; }
  // Gives the order and waits for the answer. nullopt: it was accepted; otherwise why it was not.
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
