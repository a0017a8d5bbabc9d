// Receives the answers to a procedure's questions from the bus. It takes the first answer to the
// current question; it takes an abort at any time. Pure.
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
  // From now on, takes only answers to this question; 0: takes no answers.
  void ask(std::int64_t question);
  // Takes an answer from the bus. Ignores it if it is old, repeated, not to the current question,
  // or out of range. `now_utime_us`: this host's UTC.
  void hear(const ols_msg::procedure_answer_t& answer, std::int64_t now_utime_us);
  // Returns true once for each abort.
  bool take_abort() { return std::exchange(is_aborted_, false); }
  // The answer to this question, once.
  std::optional<Answer> take(std::int64_t question);

 private:
  std::int64_t question_ = 0;
  std::optional<Answer> answer_;
  bool is_aborted_ = false;
  // Boot id and number of each taken answer. Other answers are not stored: a flood of them cannot
  // fill the memory.
  std::set<std::pair<std::int64_t, std::int64_t>> heard_;
};

}  // namespace ols::calibration
