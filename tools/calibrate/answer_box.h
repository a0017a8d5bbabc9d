// Answers that come over the bus to the question of a procedure: the first one that is meant for
// the question that stands, and an abort at any time. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <utility>

#include "calibration/procedure/stage.h"
#include "ols_msg/procedure_answer_t.hpp"

namespace ols::calibration {

class AnswerBox {
 public:
  // From now on only answers to this question are taken; 0: to none.
  void ask(std::int64_t question);
  // Refuses what is old, what was heard before, what answers no standing question, and what is out
  // of range. `now_utime_us`: this host's UTC.
  void hear(const ols_msg::procedure_answer_t& answer, std::int64_t now_utime_us);
  // Once for each abort.
  bool take_abort() { return std::exchange(is_aborted_, false); }
  // Once, and only the one to this question.
  std::optional<Answer> take(std::int64_t question);

 private:
  std::int64_t question_ = 0;
  std::optional<Answer> answer_;
  bool is_aborted_ = false;
  // Sender's boot and number; of those that were taken, so that no flood can make it grow.
  std::set<std::pair<std::int64_t, std::int64_t>> heard_;
};

}  // namespace ols::calibration
