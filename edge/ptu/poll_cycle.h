// One poll of a ready unit: sends its queries, counts missing replies, and dates the positions that
// the unit read. Pure.
//
// Replies have no checksum, so each position is requested twice in a cycle:
//
//   PP <commands> TP <commands> TP <commands> PP <questions>
//
// A wrong digit then shows as a contradiction. If a reply is lost, the later ones are taken for the
// wrong queries; in this order, such replies cannot confirm each other. The commands are placed
// between the queries: their short replies leave the line free for the next position, so that its
// instant is known well.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"
#include "edge/ptu/reply_timing.h"

namespace ols::ptu {

using PtuReadings = std::array<PtuReading, 2>;  // those of one axis, in order of time

class PollCycle {
 public:
  // `commands` are answered without a value, `questions` with text. `usual_latency_s`: an average
  // of latency_s().
  PollCycle(const PtuRequest& commands, const PtuRequest& questions, double sent_s, double byte_s,
            double usual_latency_s);

  const std::string& bytes() const { return request_.bytes(); }
  // The instant at which the last byte of the request is on the line.
  double sent_out_s() const;
  // The instant by which all replies will have arrived, if the unit takes no longer than `slack_s`
  // for them.
  double due_s(double slack_s) const;

  // `late_s`: the longest time for which the reply's bytes may have waited before they were read.
  void take(const PtuReply& reply, double late_s);
  bool complete() const { return taken_ == slots_.size(); }

  // Whether the reply to a position query is missing or unusable; then the cycle gives no
  // positions.
  bool spoilt() const { return spoilt_; }
  // Whether the reply to a command is missing; then the unit may not have accepted the command.
  bool command_lost() const { return command_lost_; }
  // Texts of `! text` replies.
  const std::vector<std::string>& refusals() const { return refusals_; }
  // Whether echo or verbose replies are on, so that the unit must have forgotten its modes.
  bool modes_forgotten() const { return modes_forgotten_; }

  // The time from the end of the first query to the start of its reply. No other reply can delay
  // this one.
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
