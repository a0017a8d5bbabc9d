// Monitors the line between a master and a PTU, and derives the unit's angles from the answers to
// position queries. Pure.
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

  // Take the bytes on the line. `time_s`: for the master's bytes, when sending to the unit starts;
  // for the unit's bytes, when all have arrived. `byte_s`: duration of one byte on the unit's line.
  void master_said(std::string_view bytes, double time_s, double byte_s);
  void unit_said(std::string_view bytes, double time_s, double byte_s);

  // The unit or its line was gone: pending queries will not be answered.
  void interrupted();

  // The unit's angles, interpolated between readings. After the newest reading they are
  // extrapolated for a while, then constant.
  PanTilt at(double time_s) const;

  // The instant up to which both axes have been read; far in the past if one has never been read.
  double known_until_s() const;

  struct Counters {                // only increase
    std::uint64_t readings = 0;    // accepted positions, counted for each axis
    std::uint64_t mismatched = 0;  // replies that did not match the query
  };
  const Counters& counters() const { return counters_; }

 private:
  struct Asked {
    std::string command;
    double sent_s;  // when its last byte was on the line
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
  std::string begun_;          // incomplete command
  double line_free_s_ = 0.0;   // when the master's bytes have left the line
  double last_reply_s_ = 0.0;  // when the last reply began,
  double line_until_s_ = 0.0;  // and when it ended
  double usual_s_ = 1e-3;      // usual latency of the unit's answers
  std::deque<Asked> asked_;    // unanswered queries
  // Readings from the current burst of commands; used if the burst ends without a mismatch.
  std::vector<Reading> taken_;
  Counters counters_;
};

}  // namespace ols::sim
