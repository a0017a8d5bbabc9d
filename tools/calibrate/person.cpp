#include "tools/calibrate/person.h"

#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "base/text/plain_text.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

std::string without_comment(const std::string& line) {
  const std::string text = line.substr(0, line.find('#'));
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

Answer answer_of(const std::string& line) {
  static const std::set<std::string> kAlone{"confirm",    "skip",  "accept", "redo",
                                            "keep",       "abort", "again",  "filter_on",
                                            "filter_off", "sight", "done"};
  static const std::set<std::string> kOfPixel{"point", "exactly"};
  std::istringstream words(line);
  Answer answer;
  words >> answer.choice;
  double first = 0.0, second = 0.0;
  if (kOfPixel.contains(answer.choice) || answer.choice == "turn") {
    if (!(words >> first >> second) || !std::isfinite(first) || !std::isfinite(second)) {
      throw std::invalid_argument("'" + answer.choice + "' needs two numbers");
    }
    if (answer.choice == "turn") {
      constexpr double kMost_deg = 360.0;
      if (std::abs(first) > kMost_deg || std::abs(second) > kMost_deg) {
        throw std::invalid_argument("'turn' is of 360 degrees at most");
      }
      answer.turn = {radians(first), radians(second)};
    } else {
      answer.pixel = Eigen::Vector2d(first, second);
    }
  } else if (!kAlone.contains(answer.choice)) {
    throw std::invalid_argument("'" + plain_text(line) + "' is no answer");
  }
  std::string rest;
  if (words >> rest) throw std::invalid_argument("'" + plain_text(rest) + "' is too much");
  return answer;
}

Person::Person(const std::string& script) : scripted_(!script.empty()) {
  if (!scripted_) return;
  std::ifstream file(script);
  if (!file) throw std::runtime_error(script + ": cannot be read");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const std::string text = without_comment(line);
    if (text.empty()) continue;
    try {
      answer_of(text);
    } catch (const std::invalid_argument& error) {
      throw std::runtime_error(script + ":" + std::to_string(number) + ": " + error.what());
    }
    script_.push_back(text);
  }
}

void Person::tell(const std::string& line) {
  std::printf("%s\n", line.c_str());
  std::fflush(stdout);
}

void Person::progress(const std::string& line) {
  if (line == last_progress_) return;
  last_progress_ = line;
  tell(line);
}

void Person::read_typed() {
  char buffer[256];
  pollfd input{STDIN_FILENO, POLLIN, 0};
  while (!at_end_ && ::poll(&input, 1, 0) > 0) {
    const ssize_t n = ::read(STDIN_FILENO, buffer, sizeof buffer);
    if (n <= 0) at_end_ = true;
    if (n > 0) typed_.append(buffer, static_cast<std::size_t>(n));
  }
}

void Person::ask(const Question& question) {
  if (!scripted_) {
    read_typed();
    std::istringstream lines(std::exchange(typed_, ""));
    for (std::string line; std::getline(lines, line);) {
      if (without_comment(line) == "abort") typed_ = "abort\n";
    }
  }
  std::string choices;
  for (const std::string& one : question.choices) choices += (choices.empty() ? "" : " | ") + one;
  tell(question.text);
  if (question.crosshair_px) {
    const std::string text =
        printed("crosshair at %.2f %.2f px, 1-sigma %.2f px", question.crosshair_px->x(),
                question.crosshair_px->y(), question.crosshair_sd_px);
    tell(text);
  }
  tell("> " + choices + " | abort");
}

void Person::ask_again(const Question& question) {
  const auto end = question.text.rfind('\n');
  progress("  " + question.text.substr(end == std::string::npos ? 0 : end + 1));
}

std::optional<Answer> Person::answer() {
  if (scripted_) {
    if (script_.empty()) return std::nullopt;
    const std::string line = script_.front();
    script_.pop_front();
    tell("< " + line);
    return answer_of(line);
  }
  read_typed();
  const auto end = typed_.find('\n');
  if (end == std::string::npos) return std::nullopt;
  const std::string line = without_comment(typed_.substr(0, end));
  typed_.erase(0, end + 1);
  if (line.empty()) return std::nullopt;
  try {
    return answer_of(line);
  } catch (const std::invalid_argument& error) {
    tell(std::string(error.what()) + "; once more:");
    return std::nullopt;
  }
}

}  // namespace ols::calibration
