// Hardware in the loop: a real PTU's serial device, with a pseudo terminal in between for the
// station. Bytes pass both ways unchanged; the positions among them tell where the unit points.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/ptu_device.h"

namespace ols::sim {

struct PtuTapConfig {
  std::string device;         // of the unit, for example /dev/ttyUSB0
  int baud = 9600;            // until the station talks: its rate is followed then
  double step_rad = 5.61e-5;  // of a count, until the unit has been asked for it
};

class PtuTap : public PtuDevice {
 public:
  // `link`: where the station finds its line, as long as the unit's device is there. A device that
  // is missing is waited for. Throws std::system_error when there cannot be such a link.
  PtuTap(const PtuTapConfig& config, std::uint64_t seed, const std::string& link);
  ~PtuTap() override;

  // Those of the line; what happens to the unit itself is not in our hands.
  void set_faults(const PtuFaults& faults) override;

  // A unit tells where it is some thirty times a second: about half of the instants of which a
  // camera draws lie behind what it has said by then.
  void await(double monotonic_s) override;

  // As far as the unit has said.
  PanTilt angles_at(double monotonic_s) override;

  struct Counters {                              // only go up
    std::uint64_t opened = 0, failures = 0;      // of the unit's device
    std::uint64_t readings = 0, mismatched = 0;  // of positions
  };
  Counters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
