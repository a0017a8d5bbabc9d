// The person at the terminal, or a script in his place: shows what a procedure does and reads
// answers.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

// An answer as a line: "confirm", "point 640.2 481", "exactly 640.2 481", "turn 2.5 -1" (degrees of
// pan and tilt), "skip", "accept", "redo", "keep", "abort", "again", "filter_on", "filter_off",
// "sight", "done". std::invalid_argument for another one.
Answer answer_of(const std::string& line);

class Person {
 public:
  // `script`: a file with an answer a line (# begins a comment); empty: the terminal, if there is
  // one. std::runtime_error naming file and line.
  explicit Person(const std::string& script);

  void tell(const std::string& line);
  // A line that replaces the last of its sort, for progress.
  void progress(const std::string& line);
  // What was typed before is no answer to it; an abort is one to any.
  void ask(const Question& question);
  // The question with another picture: what is typed stays an answer to it. Only its last line is
  // shown, where its number stands.
  void ask_again(const Question& question);
  // The answer to the question that was asked; nothing yet. A line that is none is said, and the
  // question stands.
  std::optional<Answer> answer();
  // Nobody answers here: the script is at its end, and no terminal is there.
  bool is_silent() const { return scripted_ && script_.empty(); }

 private:
  void read_typed();

  bool scripted_ = false;
  std::deque<std::string> script_;
  std::string typed_;
  bool at_end_ = false;
  std::string last_progress_;
};

}  // namespace ols::calibration
