// The driver and the simulated unit, connected by a serial line, in simulated time.
#pragma once

#include <functional>
#include <random>
#include <string>

#include "edge/ptu/driver.h"
#include "geometry/angles.h"
#include "sim/ptu/unit.h"

namespace ols::ptu {

inline sim::PtuUnitConfig quick_unit(int baud = 38400) {
  sim::PtuUnitConfig config;
  config.baud = baud;
  config.home_at_power_up = false;
  return config;
}

inline PtuConfig quick_driver(int baud = 38400) {
  PtuConfig config;
  config.baud = baud;
  config.poll_interval_s = 0.025;
  return config;
}

class ClosedLoop {
 public:
  static constexpr double kTick_s = 1e-3;

  ClosedLoop(const PtuConfig& driver_config, const sim::PtuUnitConfig& unit_config,
             double power_up_s = 10.0)
      : unit(unit_config, 7, power_up_s), driver(driver_config), time_s(power_up_s) {}

  // Advances the time by one millisecond.
  void tick() {
    time_s += kTick_s;
    const double now_s = time_s;
    unit.set_master_baud(driver.line_baud());  // as the driver's thread sets the port
    std::string request = driver.step(now_s);
    if (change_request) change_request(request);
    if (!request.empty() && !cut) {
      sent += request;
      underway_ = request;
      arrives_s_ = now_s + (late_s ? late_s() : 0.0);
    }
    if (!underway_.empty() && now_s >= arrives_s_) {
      unit.receive(underway_, now_s);
      underway_.clear();
    }
    std::string reply = unit.transmit(now_s);
    if (garble) garble(reply);
    driver.receive(reply, now_s);
  }

  void run(double duration_s, const std::function<void()>& each = {}) {
    const double end_s = time_s + duration_s;
    while (time_s < end_s) {
      if (each) each();
      tick();
    }
  }

  // Runs until the driver is ready, at most `limit_s`.
  bool start(double limit_s = 5.0) {
    const double end_s = time_s + limit_s;
    while (driver.state() != PtuState::kReady && time_s < end_s) tick();
    return driver.state() == PtuState::kReady;
  }

  // A goal that begins now.
  mount::Goal goal(const PanTilt& angles, const PanTilt& rate = {}) const {
    return {time_s, angles, rate, time_s + 0.5};
  }

  PanTilt truth() const { return unit.angles_at(time_s); }

  sim::PtuUnit unit;
  PtuDriver driver;
  double time_s;
  bool cut = false;                                  // requests do not arrive
  std::function<void(std::string&)> garble;          // changes the unit's bytes
  std::function<void(std::string&)> change_request;  // changes a request on its way to the unit
  std::function<double()> late_s;                    // how long this host delays a request
  std::string sent;

 private:
  std::string underway_;
  double arrives_s_ = 0.0;
};

}  // namespace ols::ptu
