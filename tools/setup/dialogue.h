// Asks a person the questions of ols-setup, and gives the answers the form of a file.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "tools/setup/flat_toml.h"

namespace ols::setup {

// The form of an answer. A list is typed as texts separated by spaces or commas, or as "none".
enum class Form { kText, kNumber, kList };

struct Question {
  std::string key;    // the key of the answer
  std::string words;  // the question's text
  Form form = Form::kText;
  std::string fallback{};  // as TOML; empty: an answer is required
};

// The questions of a role: "station" or "centre".
std::vector<Question> questions(const std::string& role);

// Asks for the role, then the questions of that role. For an empty line it takes the value that it
// shows in brackets: the earlier answer (`known`) or the fallback. `refused`: returns why an answer
// is impossible, or empty. Returns the answers as TOML. Throws std::runtime_error at the end of the
// input.
using Check = std::function<std::string(const Question&, const std::string& value)>;
std::string ask_all(std::istream& in, std::ostream& out, const Values& known, const Check& refused);

// Asks for a text, which must not be empty. Throws like ask_all().
std::string ask_text(std::istream& in, std::ostream& out, const std::string& words);

// Asks for one of several choices; returns its number, from 1. Throws like ask_all().
std::string ask_which(std::istream& in, std::ostream& out, const std::string& what,
                      const std::vector<std::string>& choices);

// Why the value does not have the form that the question requires; empty: it does. Checks only
// numbers.
std::string not_fitting(const Question& question, const std::string& value);

}  // namespace ols::setup
