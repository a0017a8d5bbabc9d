// A simulated telescope mount with the interface of its INDI driver: XML elements and time in, XML
// elements out. A PtzUnit simulates its axes: pan is minus the hour angle, tilt is the declination.
// Pure.
//
// The simulated mount behaves like INDI's own simulator. An abort ends a slew and leaves tracking
// on. While the mount tracks, a rate in the opposite direction is refused. A new rate has no effect
// while the mount does not track.
#pragma once

#include <cstdint>
#include <string>

#include "edge/mount/indi/telescope_axes.h"
#include "sim/onvif/ptz_unit.h"

namespace ols::sim {

struct TelescopeConfig {
  std::string address = "127.0.0.1";  // of the network interface to use
  int port = 7624;                    // 0: any
  std::string device = "OLS Telescope";
  indi::Observer observer;
  double max_speed_rad_s = radians(5.0), acceleration_rad_s2 = radians(10.0);  // of each axis
};

class Telescope {
 public:
  Telescope(const TelescopeConfig& config, std::uint64_t seed, double time_s);

  // Answers one element from a client; the answer has any number of elements. Like real drivers,
  // ignores what is not an element of INDI.
  std::string answer(const std::string& element, double time_s, double utc_s);
  // The report of the position that the driver sends without a request, every interval_s().
  std::string report(double time_s, double utc_s);
  double interval_s() const { return interval_s_; }

  void set_faults(const PtzFaults& faults, double time_s) { unit_.set_faults(faults, time_s); }
  PanTilt angles_at(double time_s) const { return unit_.angles_at(time_s); }

 private:
  std::string properties(double time_s, double utc_s) const;
  std::string position(const char* element, double time_s, double utc_s) const;
  std::string choose(const std::string& property, const std::string& chosen, double time_s);
  std::string set(const std::string& property, double first, double second, double time_s,
                  double utc_s);
  void drive(double time_s);
  void halt(double time_s);

  TelescopeConfig config_;
  PtzUnit unit_;
  bool connected_ = false, tracks_ = false, parked_ = false, slews_ = false;
  indi::TrackRate rate_, ordered_;  // rate of tracking; last ordered rate
  double interval_s_ = 1.0;
};

}  // namespace ols::sim
