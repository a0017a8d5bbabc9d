// The simulated PTU with faults of the unit and of its serial line. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "sim/ptu/reply_faults.h"
#include "sim/ptu/unit.h"
#include "sim/scenario/faults.h"

namespace ols::sim {

class FaultyPtuUnit {
 public:
  FaultyPtuUnit(const PtuUnitConfig& config, std::uint64_t seed, double power_up_s);

  void set_faults(const PtuFaults& faults, double time_s);
  bool line_gone() const { return faults_.line_gone; }

  // As in PtuUnit.
  void set_master_baud(int baud) { unit_.set_master_baud(baud); }
  void receive(std::string_view bytes, double time_s);
  std::string transmit(double time_s);
  std::optional<double> next_output_s() const { return unit_.next_output_s(); }
  PanTilt angles_at(double time_s) const { return unit_.angles_at(time_s); }

  // The faults that the line adds to the unit's answers.
  const PtuReplyFaults& replies() const { return replies_; }

 private:
  bool open() const { return !faults_.line_cut && !faults_.line_gone; }

  PtuUnit unit_;
  PtuFaults faults_;
  PtuReplyFaults replies_;
};

}  // namespace ols::sim
