// The settings and queries that precede any motion of a PTU, one command at a time. Pure.
//
// Replies have no checksum. Values that determine the angle of a count or the permitted travel are
// therefore queried until two successive answers agree.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"
#include "edge/ptu/unit_model.h"

namespace ols::ptu {

// The values that a unit states about one of its axes.
struct PtuAxisFacts {
  double resolution_rad = 0.0;                    // per count
  std::int32_t min = 0, max = 0;                  // [counts]
  std::int32_t lower_speed = 0, upper_speed = 0;  // [counts/s]
  std::int32_t acceleration = 0;                  // [counts/s^2]
};

struct PtuFacts {
  PtuAxisFacts pan, tilt;
  std::string firmware;
};

struct PtuStartOptions {
  double acceleration_rad_s2 = 1.0;  // for both axes; a unit that refuses this value keeps its own
  int change_baud_to = 0;            // 0 leaves the baud rate unchanged
  // Letters of the unit's modes; 0 leaves a mode unchanged.
  char step_mode = 0;   // E-series: H, Q, E (half, quarter, eighth step) or A (automatic)
  char hold_power = 0;  // R, L, O: regular, low, off
  char move_power = 0;  // H, R, L: high, regular, low
};

class PtuStartSequence {
 public:
  explicit PtuStartSequence(const PtuStartOptions& options);
  PtuStartSequence(const PtuStartSequence&) = delete;  // its steps contain pointers to it
  PtuStartSequence& operator=(const PtuStartSequence&) = delete;

  bool done() const { return next_ == steps_.size(); }
  PtuRequest request() const { return steps_.at(next_).request(); }
  // How long to wait for the answer to request(). It is longer than `normal_s` for setting an
  // acceleration and for waiting until a motion ends (slow()).
  double timeout_s(double normal_s) const;
  bool slow() const { return steps_.at(next_).slow; }
  // Whether the last answer confirmed a change of the baud rate.
  bool changed_baud() const { return changed_baud_; }

  // Takes the answer to request(). Returns false if it is unusable and the unit cannot be driven
  // without it.
  bool take(const PtuReply& reply);
  // Why the unit cannot be driven, after take() has returned false for `reply`.
  std::string refusal(const PtuReply& reply) const;
  // Whether the unit cannot be driven because it has no reference and must be homed.
  bool not_referenced() const { return not_referenced_; }

  const PtuFacts& facts() const { return facts_; }

 private:
  struct Step {
    std::function<PtuRequest()> request;
    std::function<bool(const PtuReply&)> take;
    bool slow = false;
    bool twice = false;         // repeat the query until two successive answers agree
    std::string without = {};   // what is wrong without a usable reply, in words
    bool changes_baud = false;  // the baud rate changes when the unit accepts the command
  };
  void add(std::string_view command, bool slow = false);
  void require(std::string_view command, std::function<bool(const PtuReply&)> take,
               std::string_view without, bool twice);
  void add_modes(const PtuStartOptions& options);
  void add_axis(PtuAxis axis, PtuAxisFacts PtuFacts::*facts);
  void add_acceleration(PtuAxis axis, PtuAxisFacts PtuFacts::*facts);
  void add_count(PtuAxis axis, PtuAxisFacts PtuFacts::*facts, PtuQuantity quantity,
                 std::int32_t PtuAxisFacts::*value);
  bool sensible(const PtuAxisFacts& facts);

  double acceleration_rad_s2_;
  PtuFacts facts_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
  std::string previous_;  // previous answer to the same query
  int asked_ = 0;         // number of answers to the same query
  bool changed_baud_ = false, not_referenced_ = false;
};

// Whether the unit's answer to C states the independent mode: speeds are then limits of moves to
// positions, not velocities.
bool says_independent(const PtuReply& reply);

}  // namespace ols::ptu
