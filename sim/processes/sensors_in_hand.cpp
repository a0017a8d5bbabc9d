#include "sim/processes/sensors_in_hand.h"

#include <cmath>

#include "geometry/angles.h"

namespace ols::sim {
namespace {

constexpr std::uint64_t kInclinometerTag = 5000, kGnssTag = 6000;
constexpr double kInclinometer_s = 0.1, kGnss_s = 0.5;  // between two readings

device::DeviceReport working(const char* name) {
  device::DeviceReport report;
  report.name = name;
  report.state = device::DeviceState::kOk;
  return report;
}

LocalFrame antenna_of(const World& world, std::size_t station) {
  const LocalFrame ground(world.stations()[station].truth.position);
  return LocalFrame(
      geodetic_from_ecef(ground.to_ecef(world.scenario().gnss.ground_to_antenna_enu_m)));
}

}  // namespace

InclinometerInHand::InclinometerInHand(const World& world, std::size_t station,
                                       const sensors::InclinometerConfig& config)
    : config_(config),
      truth_(world.stations()[station].truth.chain),
      random_(derived_seed(world.seed(), kInclinometerTag + station)),
      noise_rad_(0.0, world.scenario().inclinometer.noise_sd_rad) {}

void InclinometerInHand::step(const InclinometerFaults& faults, double now_s) {
  constexpr double kDigit_rad = radians(0.001);
  if (now_s < due_s_) return;
  due_s_ = now_s + kInclinometer_s;
  if (faults.silent) return;
  if (!faults.stuck) {
    // Each axis of the sensor shows its own inclination to the horizontal.
    const double y_rad = std::asin(std::sin(truth_.tilt_y_rad) * std::cos(truth_.tilt_x_rad));
    const auto shown = [&](double true_rad) {
      return kDigit_rad * std::round((true_rad + noise_rad_(random_)) / kDigit_rad);
    };
    shown_.x_rad = shown(truth_.tilt_x_rad);
    shown_.y_rad = shown(y_rad);
  }
  shown_.time_s = now_s;
  readings_.push_back(sensors::origin_tilt(config_, shown_));
}

device::DeviceReport InclinometerInHand::report() const { return working("inclinometer"); }

GnssInHand::GnssInHand(const World& world, std::size_t station)
    : antenna_(antenna_of(world, station)),
      sd_m_(world.scenario().gnss.sd_m),
      random_(derived_seed(world.seed(), kGnssTag + station)) {}

void GnssInHand::step(const GnssFaults& faults, double now_s) {
  if (now_s < due_s_) return;
  due_s_ = now_s + kGnss_s;
  if (faults.silent) return;
  sensors::GnssReading reading;
  reading.time_s = now_s;
  if (!faults.no_fix) {
    std::normal_distribution<double> error_m(0.0, sd_m_);
    const double east_m = faults.jump_m + error_m(random_), north_m = error_m(random_);
    reading.fix = sensors::GnssFix::kRtkFixed;
    reading.antenna = geodetic_from_ecef(antenna_.to_ecef({east_m, north_m, error_m(random_)}));
    reading.sd_enu_m.setConstant(sd_m_);
    reading.satellites_used = 14;
  }
  readings_.push_back(reading);
}

device::DeviceReport GnssInHand::report() const { return working("gnss"); }

}  // namespace ols::sim
