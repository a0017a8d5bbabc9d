// One steady-state exchange with the unit: what was asked, which replies are still to come, and
// when the unit read the positions in them. Pure.
//
// Replies carry no checksum and no time stamp: each position is asked for twice in a cycle,
//
//   PP <commands> TP <commands> TP <commands> PP <questions>
//
// so that a wrong digit shows. The order is such that replies which slipped by one place do not
// confirm each other. Commands stand between the queries: their short replies leave the line to the
// position that follows, and its instant is known well.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"

namespace ols {

struct PtuReading {
  std::int32_t counts = 0;
  double time_s = 0.0;     // when the unit read its counter: estimate,
  double time_sd_s = 0.0;  // its standard deviation,
  double half_s = 0.0;     // and how far off it can be at most
};

using PtuReadings = std::array<PtuReading, 2>;  // of one axis, in order of time

class PollCycle {
 public:
  // `commands` are answered without a value, `questions` with a text. `usual_latency_s`: an average
  // of latency_s().
  PollCycle(const PtuRequest& commands, const PtuRequest& questions, double sent_s, double byte_s,
            double usual_latency_s);

  const std::string& bytes() const { return request_.bytes(); }
  // The last byte of the request is on the line by then, and
  double sent_out_s() const;
  // all replies are there by then, if the unit takes no longer than `slack_s` over them.
  double due_s(double slack_s) const;

  // `late_s`: the reply's bytes may have been there for so long before they were read.
  void take(const PtuReply& reply, double late_s);
  bool complete() const { return taken_ == slots_.size(); }

  // A position's reply is missing or no answer: nothing can be made of this cycle's positions.
  bool spoilt() const { return spoilt_; }
  // A command may not have been taken: its reply is missing.
  bool command_lost() const { return command_lost_; }
  const std::vector<std::string>& refusals() const { return refusals_; }  // texts of `! text`
  // Echo or verbose replies are on: the unit has forgotten its modes.
  bool modes_forgotten() const { return modes_forgotten_; }

  // From the end of the first query to the begin of its reply; nothing is ever in their way.
  double latency_s() const { return latency_s_; }

  const PtuReadings& pan() const { return pan_; }
  const PtuReadings& tilt() const { return tilt_; }
  const std::vector<PtuReply>& answers() const { return answers_; }  // to the questions

 private:
  enum class Slot { kPan, kTilt, kCommand, kQuestion };
  void ask(PtuAxis axis);
  void give(const PtuRequest& commands, std::size_t from, std::size_t to);
  void take_position(const PtuReply& reply, Slot slot);
  PtuReading read_at(const PtuReply& reply) const;
  void follow_unit(const PtuReply& reply);
  double asked_s() const;  // when the command being answered was with the unit
  double begun_s() const;  // about when the unit began with it
  bool waited(const PtuReply& reply) const;
  bool stands_for_position(const PtuReply& reply) const;

  PtuRequest request_;
  std::vector<Slot> slots_;
  double sent_s_;
  double byte_s_;
  double usual_latency_s_;
  double latency_s_ = 0.0;
  double late_s_ = 0.0;                // of the reply that is being taken
  std::optional<double> line_busy_s_;  // the last reply's end
  double unit_busy_s_ = 0.0;           // the unit was not done with the command before by then,
  double unit_free_s_ = 0.0;           // but about then
  std::size_t taken_ = 0, pans_ = 0, tilts_ = 0;
  PtuReadings pan_, tilt_;
  std::vector<PtuReply> answers_;
  std::vector<std::string> refusals_;
  bool spoilt_ = false, command_lost_ = false, modes_forgotten_ = false;
};

}  // namespace ols
