// Answers to a procedure's questions that arrive over the bus. It takes the first answer to the
// current question, and an abort at any time. Pure.
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
  // From now on only answers to this question are taken; 0: to no question.
  void ask(std::int64_t question);
  // Ignores an answer that is old or repeated, is not to the current question, or is out of range.
  // `now_utime_us`: this host's UTC.
  void hear(const ols_msg::procedure_answer_t& answer, std::int64_t now_utime_us);
  // True once for each abort.
  bool take_abort() { return std::exchange(is_aborted_, false); }
  // The answer to this question, once.
  std::optional<Answer> take(std::int64_t question);

 private:
  std::int64_t question_ = 0;
  std::optional<Answer> answer_;
  bool is_aborted_ = false;
  // sender's boot and number, only of answers that were taken, so that a flood cannot make it grow
  std::set<std::pair<std::int64_t, std::int64_t>> heard_;
};

}  // namespace ols::calibration
