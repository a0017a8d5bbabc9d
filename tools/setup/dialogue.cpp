#include "tools/setup/dialogue.h"

#include <charconv>
#include <cmath>
#include <istream>
#include <ostream>
#include <stdexcept>

#include "base/toml_text.h"

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

std::string shown(const std::string& toml) { return text_in(toml).value_or(toml); }

// As TOML.
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
    if (why.empty()) return question.is_text ? toml_text(value) : value;
    out << "  " << why << "\n";
  }
}

}  // namespace

std::vector<Question> questions(const std::string& role) {
  const Question interface { "interface", "Network interface that leads to the other computers:" };
  if (role == "centre") {
    return {interface,
            {"site", "Name of the site:"},
            {"root", "File for the site's root key, on a stick:", true, "\"/media/root.key\""}};
  }
  return {interface,
          {"invitation", "The site's invitation (ols-setup says it at the centre):"},
          {"station.id", "Name of this station:"},
          {"station.pose.latitude_deg", "Latitude of the tripod, WGS84 [deg]:", false},
          {"station.pose.longitude_deg", "Longitude, east positive [deg]:", false},
          {"station.pose.height_m", "Height above the ellipsoid [m]:", false},
          {"station.pose.heading_deg", "Heading of the PTU's zero pan [deg]:", false},
          {"station.calibration.sd.heading_deg", "How well is the heading known, 1-sigma [deg]?",
           false, "0.5"},
          {"station.calibration.sd.mount_deg", "And the camera's mounting, 1-sigma [deg]?", false,
           "0.1"},
          {"station.lens.fx_px", "Focal length along x [px]:", false},
          {"station.lens.fy_px", "Focal length along y [px]:", false}};
}

std::string ask_all(std::istream& in, std::ostream& out, const Values& known,
                    const Check& refused) {
  Values answers{{"role", ask(in, out, kRole, known, refused)}};
  const std::string role = shown(answers.front().second);
  for (const Question& question : questions(role)) {
    answers.emplace_back(question.key, ask(in, out, question, known, refused));
  }
  // What only a file says stays.
  const std::string* before = find(known, "role");
  const bool same_role = before == nullptr || shown(*before) == role;
  for (const auto& [key, value] : known) {
    if (same_role && find(answers, key) == nullptr) answers.emplace_back(key, value);
  }
  return as_toml(answers);
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

// It has no 045 and no .5.
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
  if (question.is_text) return "";
  double number = 0.0;
  const char* end = value.data() + value.size();
  const auto parsed = std::from_chars(value.data(), end, number);
  const bool good = parsed.ec == std::errc() && parsed.ptr == end && std::isfinite(number);
  return good && is_toml(value) ? "" : "a number is needed, like 12.5";
}

}  // namespace ols::setup
