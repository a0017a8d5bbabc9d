// Listens to the line between a master and a PTU, and knows from the position queries that pass by
// where the unit points. Pure.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/ptu/angle_history.h"
#include "edge/ptu/codec.h"

namespace ols::sim {

class PtuTapWatch {
 public:
  // `step_rad`: of a count, until the unit has been asked for its resolution.
  explicit PtuTapWatch(double step_rad);

  // What passes, with an instant [s]: bytes of the master from when on they are sent to the unit,
  // bytes of the unit that had all come by then. `byte_s`: what one takes on the unit's line.
  void master_said(std::string_view bytes, double time_s, double byte_s);
  void unit_said(std::string_view bytes, double time_s, double byte_s);

  // The unit or its line was gone: nothing that was asked will be answered.
  void interrupted();

  // Where the unit points, interpolated; after the newest reading going on as it moved, and after
  // a while without any staying where it was last seen.
  PanTilt at(double time_s) const;

  // The newest instant at which both axes were read; long ago when they were not.
  double known_until_s() const;

  struct Counters {                // only go up
    std::uint64_t readings = 0;    // positions of either axis
    std::uint64_t mismatched = 0;  // replies that were not what had been asked for
  };
  const Counters& counters() const { return counters_; }

 private:
  struct Asked {
    std::string command;
    double sent_s;  // its last byte was on the line
  };
  struct Reading {
    int axis;
    ptu::AngleSample sample;
  };
  void take(const ptu::PtuReply& reply, double byte_s);
  void drop_questions();
  void read(int axis, const Asked& asked, const ptu::PtuReply& reply, double byte_s);

  std::array<double, 2> step_rad_;
  std::array<ptu::AngleHistory, 2> history_;  // each axis is read at instants of its own
  ptu::PtuReplyParser parser_;
  std::string begun_;           // command without its end yet
  double line_free_s_ = 0.0;    // the master's bytes
  double last_reply_s_ = 0.0;   // begin of the last reply,
  double line_until_s_ = 0.0;   // and its end
  double usual_s_ = 1e-3;       // that the unit takes to answer
  std::deque<Asked> asked_;     // not answered yet
  std::vector<Reading> taken_;  // of this burst of commands, to be believed when it ends well
  Counters counters_;
};

}  // namespace ols::sim
