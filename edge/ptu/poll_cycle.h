// One poll cycle of a ready unit: the bytes to send, the assignment of replies to commands, and the
// times at which the unit read its positions. Pure.
//
// Replies have no checksum. Each position is therefore requested twice in a cycle:
//
//   PP <commands> TP <commands> TP <commands> PP <questions>
//
// A wrong digit then causes a contradiction. If a reply is lost, the later replies are assigned to
// the wrong queries; in the order above, wrongly assigned replies cannot confirm each other. The
// commands are placed between the queries, because their short replies leave the line free for the
// reply with the next position. The time of this position is then known more accurately.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"
#include "edge/ptu/reply_timing.h"

namespace ols::ptu {

using PtuReadings = std::array<PtuReading, 2>;  // the two readings of one axis, in order of time

class PollCycle {
 public:
  // `commands`: the unit answers these without a value. `questions`: it answers these with text.
  // `usual_latency_s`: an average of latency_s() of earlier cycles.
  PollCycle(const PtuRequest& commands, const PtuRequest& questions, double sent_s, double byte_s,
            double usual_latency_s);

  const std::string& bytes() const { return request_.bytes(); }
  // The time at which the last byte of the request has been sent.
  double sent_out_s() const;
  // The time by which all replies have arrived, if the unit itself needs at most `slack_s`.
  double due_s(double slack_s) const;

  // Takes the next reply. `late_s`: the longest time for which its bytes may have waited before
  // they were read.
  void take(const PtuReply& reply, double late_s);
  bool complete() const { return taken_ == slots_.size(); }

  // Whether the reply to a position query is missing or unusable. The cycle then gives no
  // positions.
  bool spoilt() const { return spoilt_; }
  // Whether the reply to a command is missing. The unit may then not have executed the command.
  bool command_lost() const { return command_lost_; }
  // The texts of `! text` replies to commands.
  const std::vector<std::string>& refusals() const { return refusals_; }
  // Whether echo or verbose replies are on: the unit has forgotten its modes.
  bool modes_forgotten() const { return modes_forgotten_; }

  // The time from the end of the first query to the start of its reply. This reply is not delayed
  // by other replies.
  double latency_s() const { return latency_s_; }

  const PtuReadings& pan() const { return pan_.readings; }
  const PtuReadings& tilt() const { return tilt_.readings; }
  const std::vector<PtuReply>& answers() const { return answers_; }  // answers to the questions

 private:
  enum class Slot { kPan, kTilt, kCommand, kQuestion };
  struct Axis {
    PtuReadings readings;
    std::size_t taken = 0;
  };
  void ask(PtuAxis axis);
  void give(const PtuRequest& commands, std::size_t from, std::size_t to);
  void take_position(const PtuReply& reply, Axis& axis, double asked_s, double late_s);

  PtuRequest request_;
  std::vector<Slot> slots_;
  double sent_s_;
  double byte_s_;
  ReplyTiming timing_;
  double latency_s_ = 0.0;
  std::size_t taken_ = 0;
  Axis pan_, tilt_;
  std::vector<PtuReply> answers_;
  std::vector<std::string> refusals_;
  bool spoilt_ = false, command_lost_ = false, modes_forgotten_ = false;
};

}  // namespace ols::ptu
