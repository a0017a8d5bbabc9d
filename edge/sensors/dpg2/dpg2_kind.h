// The inclinometer kind for the DPG2 (edge/sensors/inclinometer.h).
#pragma once

#include <memory>
#include <string>

#include "edge/sensors/dpg2/dpg2_inclinometer.h"
#include "edge/sensors/inclinometer.h"

namespace ols::sensors {

class Dpg2Kind : public InclinometerKind {
 public:
  config::Section section() override;
  const InclinometerConfig& config() const override { return dpg2; }
  bool is_configured() const override { return !dpg2.device.empty(); }
  std::string address() const override;
  std::unique_ptr<Inclinometer> open() const override {
    return std::make_unique<Dpg2Inclinometer>(dpg2);
  }

  Dpg2Config dpg2;
};

}  // namespace ols::sensors
