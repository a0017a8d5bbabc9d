// The questions of ols-setup to a person, and the answers as a file would give them.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "tools/setup/flat_toml.h"

namespace ols::setup {

// Of an answer. A list is typed with spaces or commas between its texts, or as "none".
enum class Form { kText, kNumber, kList };

struct Question {
  std::string key;    // of the answers
  std::string words;  // what is asked
  Form form = Form::kText;
  std::string fallback{};  // as TOML; empty: an answer is needed
};

// Of a role: "station" or "centre".
std::vector<Question> questions(const std::string& role);

// Asks for the role and then its questions; an empty line takes what is shown in brackets: the
// answer of before (`known`), or the fallback. `refused`: why an answer cannot be, or empty.
// Returns the answers as TOML. Throws std::runtime_error at the end of the input.
using Check = std::function<std::string(const Question&, const std::string& value)>;
std::string ask_all(std::istream& in, std::ostream& out, const Values& known, const Check& refused);

// A text that is needed. Throws like ask_all().
std::string ask_text(std::istream& in, std::ostream& out, const std::string& words);

// Which of several; their number from 1. Throws like ask_all().
std::string ask_which(std::istream& in, std::ostream& out, const std::string& what,
                      const std::vector<std::string>& choices);

// A number where one is needed; any text where a text or a list is.
std::string not_fitting(const Question& question, const std::string& value);

}  // namespace ols::setup
