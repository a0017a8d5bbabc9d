// Hardware in the loop: a pseudo terminal between the station and a real PTU's serial device. Bytes
// pass unchanged in both directions. The unit's replies to position queries show where it points.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "sim/ptu/device.h"

namespace ols::sim {

struct PtuTapConfig {
  std::string device;  // of the unit, for example /dev/ttyUSB0
  int baud = 9600;     // until the station has opened the line; then the station's rate applies
  double step_rad = 5.61e-5;  // size of a count, until the unit has reported it
};

class PtuTap : public PtuDevice {
 public:
  // `link`: path of the link that the station opens. The link exists only while the unit's device
  // exists. Waits for a missing device. Throws std::system_error if the link cannot be made.
  PtuTap(const PtuTapConfig& config, std::uint64_t seed, const std::string& link);
  ~PtuTap() override;

  // Faults of the line only: faults of a real unit cannot be simulated.
  void set_faults(const PtuFaults& faults) override;

  // Waits for the first report after this instant. A unit reports its position about thirty times a
  // second, so about half of the pictures are drawn for an instant after the newest report.
  void await(double monotonic_s) override;

  // Based on the unit's reports so far.
  PanTilt angles_at(double monotonic_s) override;

  struct Counters {                              // only increase
    std::uint64_t opened = 0, failures = 0;      // openings and failures of the unit's device
    std::uint64_t readings = 0, mismatched = 0;  // as PtuTapWatch::Counters
  };
  Counters counters() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::sim
