// Collects the operator's commands during one cycle of the control loop. Only the newest
// designation of a cycle is carried out, because each one makes the tracker process all frames
// since the image in which the object was designated. A stop never waits for a designation. Pure.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "edge/station/station.h"

namespace ols::station {

// Identifies a command by its sender's boot id and its sequence number.
struct CommandId {
  std::int64_t boot_id = 0, sequence = 0;
};

// The result of a designation.
struct Decision {
  CommandId command;
  Refusal refusal = Refusal::kNone;
};

class CommandTurn {
 public:
  // `station` must outlive this object.
  explicit CommandTurn(Station& station) : station_(station) {}

  // Notes a stop; end() carries it out. May be called from any thread, and does not wait.
  void stop() { stop_ = true; }

  // Takes a designation. It is carried out at the end of the cycle, or before the next command of
  // another kind.
  void designate(const DesignateCommand& command, const CommandId& id);
  // Call before any other operator command. Carries out the pending designation. If another one has
  // already been carried out in this cycle, the pending one is dropped instead. Therefore, a cycle
  // carries out at most two designations.
  void before_other_command(double now_s);
  // Call after the last command of the cycle.
  void end(double now_s);

  // The results of all designations since the last call.
  std::vector<Decision> take_decisions() { return std::exchange(decisions_, {}); }

  // Number of designations that were dropped because of another designation or a stop.
  std::uint64_t superseded() const { return superseded_; }

 private:
  void carry_out_designation(double now_s);
  void drop_designation(Refusal why);

  Station& station_;
  std::atomic<bool> stop_ = false;
  std::optional<std::pair<DesignateCommand, CommandId>> designation_;
  std::vector<Decision> decisions_;
  bool designated_ = false;  // a designation was carried out in this cycle
  std::uint64_t superseded_ = 0;
};

}  // namespace ols::station
