// The person at the terminal, or a script in that person's place: shows the procedure's steps and
// reads the answers.
#pragma once

#include <deque>
#include <optional>
#include <string>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

// Reads an answer from a line: "confirm", "point 640.2 481", "exactly 640.2 481", "turn 2.5 -1"
// (degrees of pan and tilt), "skip", "accept", "redo", "keep", "abort", "again", "filter_on",
// "filter_off", "sight", "done". Throws std::invalid_argument for any other line.
Answer answer_of(const std::string& line);

class Person {
 public:
  // `script`: a file with one answer per line (# begins a comment); empty: the terminal, if there
  // is one. Throws std::runtime_error naming file and line.
  explicit Person(const std::string& script);

  void tell(const std::string& line);
  // Shows a line that replaces the previous progress line.
  void progress(const std::string& line);
  // Shows a question. Discards everything typed earlier, except "abort".
  void ask(const Question& question);
  // Shows the same question for another picture: only the last line of its text, which has the
  // measured value. Input that was typed earlier still counts as an answer.
  void ask_again(const Question& question);
  // The answer to the question; nullopt: there is none yet. Reports an invalid line; the question
  // stays open.
  std::optional<Answer> answer();
  // Whether nobody can answer: the script has ended, and there is no terminal.
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
