// The inclinometer and the GNSS receiver of a station in simulated time: their readings, without a
// serial line (sim/sensors simulates the devices with their lines). step() produces the readings
// that are due at an instant of the monotonic clock. Pure.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"
#include "sim/scenario/faults.h"
#include "sim/world/world.h"

namespace ols::sim {

class InclinometerInHand : public sensors::Inclinometer {
 public:
  InclinometerInHand(const World& world, std::size_t station,
                     const sensors::InclinometerConfig& config);

  void step(const InclinometerFaults& faults, double now_s);
  std::vector<sensors::TiltReading> take_readings() override {
    return std::exchange(readings_, {});
  }
  device::DeviceReport report() const override;

 private:
  const sensors::InclinometerConfig config_;
  const ChainParameters truth_;
  std::mt19937_64 random_;
  std::normal_distribution<double> noise_rad_;
  double due_s_ = 0.0;
  sensors::AxisAngles shown_;
  std::vector<sensors::TiltReading> readings_;
};

class GnssInHand : public sensors::Gnss {
 public:
  GnssInHand(const World& world, std::size_t station);

  void step(const GnssFaults& faults, double now_s);
  std::vector<sensors::GnssReading> take_readings() override {
    return std::exchange(readings_, {});
  }
  device::DeviceReport report() const override;

 private:
  const LocalFrame antenna_;
  const double sd_m_;
  std::mt19937_64 random_;
  double due_s_ = 0.0;
  std::vector<sensors::GnssReading> readings_;
};

}  // namespace ols::sim
