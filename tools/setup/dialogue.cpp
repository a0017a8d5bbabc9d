#include "tools/setup/dialogue.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>
#include <ostream>
#include <sstream>
#include <stdexcept>

#include "base/config/toml_text.h"

namespace ols::setup {
namespace {

const Question kRole{"role", "What is this computer: station or centre?"};

std::string read_line(std::istream& in) {
  std::string line;
  if (!std::getline(in, line)) throw std::runtime_error("the input ended before all was answered");
  const auto first = line.find_first_not_of(" \t\r");
  if (first == std::string::npos) return "";
  return line.substr(first, line.find_last_not_of(" \t\r") - first + 1);
}

constexpr const char* kNone = "none";

// A TOML value as a person types it.
std::string shown(const std::string& toml) {
  const auto list = texts_in(toml);
  if (!list) return text_in(toml).value_or(toml);
  std::string text;
  for (const std::string& one : *list) text += (text.empty() ? "" : " ") + one;
  return text.empty() ? kNone : text;
}

// What a person typed, as a TOML value.
std::string as_value(Form form, const std::string& typed) {
  if (form == Form::kNumber) return typed;
  if (form == Form::kText) return toml_text(typed);
  if (typed == kNone) return "[]";
  std::string words = typed, list;
  std::ranges::replace(words, ',', ' ');
  std::istringstream each(words);
  for (std::string word; each >> word;) list += (list.empty() ? "" : ", ") + toml_text(word);
  return "[" + list + "]";
}

// Returns the answer as TOML.
std::string ask(std::istream& in, std::ostream& out, const Question& question, const Values& known,
                const Check& refused) {
  const std::string* before = find(known, question.key);
  const std::string fallback = before != nullptr ? *before : question.fallback;
  for (;;) {
    out << question.words;
    if (!fallback.empty()) out << " [" << shown(fallback) << "]";
    out << " " << std::flush;
    const std::string line = read_line(in);
    const std::string value = line.empty() ? shown(fallback) : line;
    std::string why = value.empty() && fallback.empty() ? "an answer is needed" : "";
    if (why.empty()) why = refused(question, value);
    if (why.empty()) return as_value(question.form, value);
    out << "  " << why << "\n";
  }
}

}  // namespace

std::vector<Question> questions(const std::string& role) {
  const Question interface { "interface", "Network interface that leads to the other computers:" };
  const Question neighbours{
      "neighbours",
      "IP addresses of these, which keep each other's time without GNSS:", Form::kList, "[]"};
  if (role == "centre") {
    return {
        interface,
        neighbours,
        {"site", "Name of the site:"},
        {"root", "File for the site's root key, on a stick:", Form::kText, "\"/media/root.key\""}};
  }
  return {interface,
          neighbours,
          {"invitation", "The site's invitation (ols-setup says it at the centre):"},
          {"station.id", "Name of this station:"},
          {"station.pose.latitude_deg", "Latitude of the tripod, WGS84 [deg]:", Form::kNumber},
          {"station.pose.longitude_deg", "Longitude, east positive [deg]:", Form::kNumber},
          {"station.pose.height_m", "Height above the ellipsoid [m]:", Form::kNumber},
          {"station.pose.heading_deg", "Heading of the PTU's zero pan [deg]:", Form::kNumber},
          {"station.calibration.sd.heading_deg", "How well is the heading known, 1-sigma [deg]?",
           Form::kNumber, "0.5"},
          {"station.calibration.sd.mount_deg", "And the camera's mounting, 1-sigma [deg]?",
           Form::kNumber, "0.1"},
          {"station.lens.fx_px", "Focal length along x [px]:", Form::kNumber},
          {"station.lens.fy_px", "Focal length along y [px]:", Form::kNumber}};
}

std::string ask_all(std::istream& in, std::ostream& out, const Values& known,
                    const Check& refused) {
  Values answers{{"role", ask(in, out, kRole, known, refused)}};
  const std::string role = shown(answers.front().second);
  for (const Question& question : questions(role)) {
    answers.emplace_back(question.key, ask(in, out, question, known, refused));
  }
  // Keeps what only a file can state.
  const std::string* before = find(known, "role");
  const bool same_role = before == nullptr || shown(*before) == role;
  for (const auto& [key, value] : known) {
    if (same_role && find(answers, key) == nullptr) answers.emplace_back(key, value);
  }
  return as_toml(answers);
}

std::string ask_text(std::istream& in, std::ostream& out, const std::string& words) {
  const Question question{"", words};
  return *text_in(ask(in, out, question, {}, [](const auto&, const auto&) { return ""; }));
}

std::string ask_which(std::istream& in, std::ostream& out, const std::string& what,
                      const std::vector<std::string>& choices) {
  for (std::size_t i = 0; i < choices.size(); ++i)
    out << "  " << i + 1 << "  " << choices[i] << "\n";
  for (;;) {
    out << what << " [1] " << std::flush;
    const std::string line = read_line(in);
    std::size_t number = line.empty() ? 1 : 0;
    std::from_chars(line.data(), line.data() + line.size(), number);
    if (number >= 1 && number <= choices.size()) return choices[number - 1];
    out << "  a number from 1 to " << choices.size() << "\n";
  }
}

namespace {

// TOML has no 045 and no .5.
bool is_toml(const std::string& value) {
  try {
    return !flat("x = " + value).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

std::string not_fitting(const Question& question, const std::string& value) {
  if (question.key == "role") {
    return value == "station" || value == "centre" ? "" : "station or centre";
  }
  if (question.form != Form::kNumber) return "";
  double number = 0.0;
  const char* end = value.data() + value.size();
  const auto parsed = std::from_chars(value.data(), end, number);
  const bool good = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(number);
  return good && is_toml(value) ? "" : "a number is needed, like 12.5";
}

}  // namespace ols::setup
