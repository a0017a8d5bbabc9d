#include "sim/ptu/console.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace ols::sim {

namespace {

constexpr const char* kUsage =
    "refused: it is \"fault KIND [SECONDS [VALUE]]\", \"end KIND\", \"end all\" or \"angles "
    "[MONOTONIC_S]\"";

std::string full_name(const std::string& kind) {
  return kind.rfind("ptu-", 0) == 0 || kind == "all" ? kind : "ptu-" + kind;
}

// The next word as a number; nullopt at the end of the line. Throws std::invalid_argument for
// another word.
std::optional<double> next_number(std::istream& words) {
  std::string word;
  if (!(words >> word)) return std::nullopt;
  std::size_t used = 0;
  double value = 0.0;
  try {
    value = std::stod(word, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != word.size() || !std::isfinite(value)) {
    throw std::invalid_argument("\"" + word + "\" is not a number");
  }
  return value;
}

}  // namespace

std::variant<std::string, PtuConsole::AskedAngles> PtuConsole::take(std::string_view line,
                                                                    double now_s) {
  std::istringstream words{std::string(line)};
  std::string verb, kind, rest;
  if (!(words >> verb)) return std::string();
  try {
    if (verb == "angles") {
      const AskedAngles asked{next_number(words)};
      if (words >> rest) return std::string(kUsage);
      return asked;
    }
    if ((verb != "fault" && verb != "end") || !(words >> kind)) return std::string(kUsage);
    Fault wanted;
    wanted.kind = full_name(kind);
    if (verb == "end") {
      wanted.for_s = 0.0;
    } else {
      wanted.for_s = next_number(words).value_or(wanted.for_s);
      wanted.value = next_number(words).value_or(wanted.value);
      if (!(wanted.for_s > 0.0)) return std::string("refused: a fault must last more than 0 s");
    }
    if (words >> rest) return std::string(kUsage);
    return fault(wanted, now_s);
  } catch (const std::invalid_argument& problem) {
    return std::string("refused: ") + problem.what();
  }
}

std::string PtuConsole::fault(Fault wanted, double now_s) {
  plan_.command(std::move(wanted), now_s);
  return "done";
}

}  // namespace ols::sim
