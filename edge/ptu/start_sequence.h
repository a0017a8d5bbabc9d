// What the driver asks and sets before it may move a PTU: one command at a time. Pure.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "edge/ptu/codec.h"

namespace ols {

// What a unit says about one of its axes.
struct PtuAxisFacts {
  double resolution_rad = 0.0;                    // per count
  std::int32_t least = 0, greatest = 0;           // [counts]
  std::int32_t lower_speed = 0, upper_speed = 0;  // [counts/s]
  std::int32_t acceleration = 0;                  // [counts/s^2]
};

struct PtuFacts {
  PtuAxisFacts pan, tilt;
  std::string firmware;
};

class PtuStartSequence {
 public:
  // The acceleration is to be set on both axes; a unit that refuses keeps its own.
  explicit PtuStartSequence(double acceleration_rad_s2);
  PtuStartSequence(const PtuStartSequence&) = delete;  // its steps refer to it
  PtuStartSequence& operator=(const PtuStartSequence&) = delete;

  bool done() const { return next_ == steps_.size(); }
  PtuRequest request() const { return steps_.at(next_).request(); }
  // Setting an acceleration or waiting for a motion's end takes long.
  double timeout_s(double normal_s) const;

  // The answer to request(). False: without it the unit cannot be driven.
  bool take(const PtuReply& reply);
  // Why it cannot, after take() gave false for `reply`.
  std::string refusal(const PtuReply& reply) const;

  const PtuFacts& facts() const { return facts_; }

 private:
  struct Step {
    std::function<PtuRequest()> request;
    std::function<bool(const PtuReply&)> take;
    bool slow = false;
    std::string without = {};  // what it means when the reply will not do
  };
  void add(std::string_view command, bool slow = false);
  void require(std::string_view command, std::function<bool(const PtuReply&)> take,
               std::string_view without);
  void add_axis(PtuAxis axis, PtuAxisFacts PtuFacts::*facts);
  void add_count(PtuAxis axis, PtuAxisFacts PtuFacts::*facts, PtuQuantity quantity,
                 std::int32_t PtuAxisFacts::*value);

  double acceleration_rad_s2_;
  PtuFacts facts_;
  std::vector<Step> steps_;
  std::size_t next_ = 0;
};

}  // namespace ols
