// The operator's commands of one turn of the control loop. Only the newest designation of a turn is
// carried out, because the tracker must process all frames since its image. A stop never waits for
// a designation. Pure.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "edge/station.h"

namespace ols::station {

class CommandTurn {
 public:
  // The station must outlive it.
  explicit CommandTurn(Station& station) : station_(station) {}

  // From any thread; does not wait. end() carries it out.
  void stop() { stop_ = true; }

  // Carried out at the end of the turn, or before another command.
  void designate(const DesignateCommand& command);
  // Call before another operator command. Carries out the pending designation, unless one was
  // carried out in this turn already: so there are at most two per turn.
  Refusal before_other_command(double now_s);
  // Call after the turn's last command. Returns why the designation was refused.
  Refusal end(double now_s);

  // Designations dropped because of a newer one or a stop.
  std::uint64_t superseded() const { return superseded_; }

 private:
  Refusal carry_out_designation(double now_s);

  Station& station_;
  std::atomic<bool> stop_ = false;
  std::optional<DesignateCommand> designation_;
  bool designated_ = false;  // in this turn
  std::uint64_t superseded_ = 0;
};

}  // namespace ols::station
