#include "cue/json_reader.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ols::cues {
namespace {

using Json = nlohmann::json;

class FormError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

double number_of(const Json& value, const std::string& key) {
  if (!value.is_number()) throw FormError(key + " must be a number");
  return value.get<double>();
}

std::string text_of(const Json& value, const std::string& key) {
  if (!value.is_string()) throw FormError(key + " must be a text");
  return value.get<std::string>();
}

std::array<double, 3> three_of(const Json& value, const std::string& key) {
  if (!value.is_array() || value.size() != 3) throw FormError(key + " must be three numbers");
  return {number_of(value[0], key), number_of(value[1], key), number_of(value[2], key)};
}

std::int64_t time_of(const Json& value, const std::string& key) {
  const double time_s = number_of(value, key);
  if (!(time_s > 0.0 && time_s < 9e9)) throw FormError(key + " must be seconds since 1970");
  return std::llround(1e6 * time_s);
}

// Unknown keys are refused: a misspelt deviation would otherwise count as not stated.
void read(Report& report, const std::string& key, const Json& value) {
  if (key == "id") {
    report.name = text_of(value, key);
  } else if (key == "label") {
    report.label = text_of(value, key);
  } else if (key == "time_s") {
    report.utime_us = time_of(value, key);
  } else if (key == "latitude_deg") {
    report.latitude_deg = number_of(value, key);
  } else if (key == "longitude_deg") {
    report.longitude_deg = number_of(value, key);
  } else if (key == "height_m") {
    report.height_m = number_of(value, key);
  } else if (key == "horizontal_sd_m") {
    report.horizontal_sd_m = number_of(value, key);
  } else if (key == "vertical_sd_m") {
    report.vertical_sd_m = number_of(value, key);
  } else if (key == "velocity_enu_m_s") {
    report.velocity_enu_m_s = three_of(value, key);
  } else if (key == "velocity_sd_m_s") {
    report.velocity_sd_m_s = number_of(value, key);
  } else {
    throw FormError("unknown key " + key);
  }
}

}  // namespace

Reading json_reading(const std::string& line, std::int64_t now_us) {
  const Json json = Json::parse(line, nullptr, false);
  if (!json.is_object()) return Refused{Refusal::kMalformed, "no JSON object"};
  Report report;
  report.utime_us = now_us;
  try {
    for (const char* key : {"id", "latitude_deg", "longitude_deg"}) {
      if (!json.contains(key)) throw FormError(std::string(key) + " is missing");
    }
    for (const auto& [key, value] : json.items()) read(report, key, value);
  } catch (const FormError& error) {
    return Refused{Refusal::kMalformed, error.what()};
  }
  if (report.name.empty()) return Refused{Refusal::kMalformed, "id is empty"};
  if (!json.contains("height_m")) return Refused{Refusal::kNoHeight, report.name};
  return report;
}

}  // namespace ols::cues
