// Monitors the line between a master and a PTU, and derives the unit's angles from the position
// queries on it. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/mount/angle_history.h"
#include "edge/ptu/codec.h"

namespace ols::sim {

class PtuTapWatch {
 public:
  // `step_rad`: per count, until the unit has reported its resolution.
  explicit PtuTapWatch(double step_rad);

  // Takes the traffic, with an instant [s]. For the master's bytes: when sending to the unit
  // starts. For the unit's bytes: when all had arrived. `byte_s`: duration of one byte on the
  // unit's line.
  void master_said(std::string_view bytes, double time_s, double byte_s);
  void unit_said(std::string_view bytes, double time_s, double byte_s);

  // The unit or its line was gone: pending queries will not be answered.
  void interrupted();

  // The unit's angles, interpolated; extrapolated after the newest reading, and constant after a
  // while without any.
  PanTilt at(double time_s) const;

  // The newest instant at which both axes were read; far in the past if they never were.
  double known_until_s() const;

  struct Counters {                // only increase
    std::uint64_t readings = 0;    // positions of either axis
    std::uint64_t mismatched = 0;  // replies that did not match the query
  };
  const Counters& counters() const { return counters_; }

 private:
  struct Asked {
    std::string command;
    double sent_s;  // its last byte was on the line
  };
  struct Reading {
    int axis;
    mount::AngleSample sample;
  };
  void take(const ptu::PtuReply& reply, double byte_s);
  void drop_questions();
  void read(int axis, const Asked& asked, const ptu::PtuReply& reply, double byte_s);

  std::array<double, 2> step_rad_;
  std::array<mount::AngleHistory, 2> history_;  // each axis is read at its own instants
  ptu::PtuReplyParser parser_;
  std::string begun_;           // incomplete command
  double line_free_s_ = 0.0;    // the master's bytes
  double last_reply_s_ = 0.0;   // begin of the last reply,
  double line_until_s_ = 0.0;   // and its end
  double usual_s_ = 1e-3;       // usual latency of the unit's answers
  std::deque<Asked> asked_;     // unanswered queries
  std::vector<Reading> taken_;  // of this burst of commands, used if it ends without a mismatch
  Counters counters_;
};

}  // namespace ols::sim
