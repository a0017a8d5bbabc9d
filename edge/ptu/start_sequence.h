// The queries and settings before the driver may move a PTU: one command at a time. Pure.
//
// There is no checksum, so everything that decides the meaning of a count or the permitted travel
// is queried until two answers in a row agree.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"
#include "edge/ptu/unit_model.h"

namespace ols::ptu {

// What a unit states about one of its axes.
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
  double acceleration_rad_s2 = 1.0;  // of both axes; a unit that refuses keeps its own
  int change_baud_to = 0;            // 0: stays as it is
  // The letter of the mode; 0: unchanged.
  char step_mode = 0;   // E-series: H, Q, E (half, quarter, eighth) or A (automatic)
  char hold_power = 0;  // R, L, O: regular, low, off
  char move_power = 0;  // H, R, L: high, regular, low
};

class PtuStartSequence {
 public:
  explicit PtuStartSequence(const PtuStartOptions& options);
  PtuStartSequence(const PtuStartSequence&) = delete;  // its steps refer to it
  PtuStartSequence& operator=(const PtuStartSequence&) = delete;

  bool done() const { return next_ == steps_.size(); }
  PtuRequest request() const { return steps_.at(next_).request(); }
  // Setting an acceleration and waiting for the end of a motion take long.
  double timeout_s(double normal_s) const;
  bool slow() const { return steps_.at(next_).slow; }
  // The answer just processed was the last one at the old baud rate.
  bool changed_baud() const { return changed_baud_; }

  // The answer to request(). False: without it the unit cannot be driven.
  bool take(const PtuReply& reply);
  // Why it cannot, after take() gave false for `reply`.
  std::string refusal(const PtuReply& reply) const;
  // Because the unit has no reference: it must be homed.
  bool not_referenced() const { return not_referenced_; }

  const PtuFacts& facts() const { return facts_; }

 private:
  struct Step {
    std::function<PtuRequest()> request;
    std::function<bool(const PtuReply&)> take;
    bool slow = false;
    bool twice = false;         // until two answers agree
    std::string without = {};   // the consequence of an unusable reply
    bool changes_baud = false;  // when it is accepted
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
  std::string previous_;  // answer to the same question
  int asked_ = 0;         // number of times
  bool changed_baud_ = false, not_referenced_ = false;
};

// The answer to C says that speeds are bounds of position moves.
bool says_independent(const PtuReply& reply);

}  // namespace ols::ptu
