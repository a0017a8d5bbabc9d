// The operator's commands of one turn of the control loop: of designations that come at once only
// the newest is carried out, because each lets the tracker run through the frames since then; and a
// stop waits for none of them.
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

  // From any thread, without waiting; end() carries it out.
  void stop() { stop_ = true; }

  // Carried out at the turn's end, or before another command.
  void designate(const DesignateCommand& command);
  // Another command of the operator is about to be carried out: the designation before it comes
  // first. But two designations a turn are the most.
  Refusal before_other_command(double now_s);
  // After the turn's last command. What was refused of the designation.
  Refusal end(double now_s);

  // Designations that were not carried out because a newer one or a stop came.
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
