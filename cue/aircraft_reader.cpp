#include "cue/aircraft_reader.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cue/sbs_line.h"
#include "geometry/angles.h"

namespace ols::cues {
namespace {

using Json = nlohmann::json;

constexpr double kFoot_m = 0.3048, kKnot_m_s = 1852.0 / 3600.0, kFootPerMinute_m_s = kFoot_m / 60.0;
constexpr std::size_t kMostAircraft = 1000;  // of a file; a busy receiver has 500
constexpr std::size_t kLongestCallsign = 8;

std::optional<double> number(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::string word(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  std::string text = found->get<std::string>();
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

// The bound of 95 % that a category stands for (ICAO Doc 9871; RTCA DO-260B, NACp) is 2.45 times
// the sigma of one axis.
std::optional<double> sd_of_category(const std::optional<double>& nac_p) {
  static constexpr std::array<double, 12> kBound_m{0.0,   18520.0, 7408.0, 3704.0, 1852.0, 926.0,
                                                   555.6, 185.2,   92.6,   30.0,   10.0,   3.0};
  if (!nac_p || !(*nac_p >= 1.0 && *nac_p <= 11.0)) return std::nullopt;
  return kBound_m[static_cast<std::size_t>(*nac_p)] / 2.45;
}

std::array<double, 3> velocity(double speed_kt, double track_deg, double climb_ft_min) {
  const double track_rad = radians(track_deg);
  return {speed_kt * kKnot_m_s * std::sin(track_rad), speed_kt * kKnot_m_s * std::cos(track_rad),
          climb_ft_min * kFootPerMinute_m_s};
}

std::string place_less(const Json& one) { return word(one, "hex") + ": no height"; }

// nullopt: no position; so it is for most aircraft of a busy receiver.
std::optional<Reading> reading_of(const Json& one, double now_s) {
  const auto latitude = number(one, "lat"), longitude = number(one, "lon"),
             seen_s = number(one, "seen_pos");
  if (!latitude || !longitude || !seen_s) return std::nullopt;
  Report report;
  report.name = word(one, "hex");
  if (report.name.empty()) return Refused{Refusal::kMalformed, "an aircraft without hex"};
  report.label = word(one, "flight");
  if (!(*seen_s >= 0.0 && *seen_s < 1e6)) return Refused{Refusal::kOutOfRange, report.name};
  report.utime_us = std::llround(1e6 * (now_s - *seen_s));
  report.latitude_deg = *latitude;
  report.longitude_deg = *longitude;
  const auto geometric_ft = number(one, "alt_geom"), pressure_ft = number(one, "alt_baro");
  if (!geometric_ft && !pressure_ft) return Refused{Refusal::kNoHeight, place_less(one)};
  report.is_pressure_height = !geometric_ft;
  report.height_m = kFoot_m * (geometric_ft ? *geometric_ft : *pressure_ft);
  report.horizontal_sd_m = sd_of_category(number(one, "nac_p"));
  const auto speed_kt = number(one, "gs"), track_deg = number(one, "track");
  const auto climb = number(one, geometric_ft ? "geom_rate" : "baro_rate");
  if (speed_kt && track_deg) {
    report.velocity_enu_m_s = velocity(*speed_kt, *track_deg, climb.value_or(0.0));
  }
  return report;
}

}  // namespace

Readings aircraft_json_readings(const std::string& text) {
  const Json root = Json::parse(text, nullptr, false);
  const double now_s = root.is_object() ? number(root, "now").value_or(0.0) : 0.0;
  const auto aircraft = root.is_object() ? root.find("aircraft") : root.end();
  if (!(now_s > 0.0 && now_s < 9e9) || aircraft == root.end() || !aircraft->is_array()) {
    return {Refused{Refusal::kMalformed, "is no aircraft.json"}};
  }
  Readings readings;
  for (std::size_t i = 0; i < aircraft->size(); ++i) {
    if (i == kMostAircraft) {
      readings.emplace_back(Refused{Refusal::kTooMany, "more aircraft than 1000"});
      break;
    }
    const Json& one = (*aircraft)[i];
    if (!one.is_object()) {
      readings.emplace_back(Refused{Refusal::kMalformed, "an aircraft that is no object"});
    } else if (auto reading = reading_of(one, now_s)) {
      readings.push_back(std::move(*reading));
    }
  }
  return readings;
}

SbsReader::Aircraft& SbsReader::aircraft(const std::string& icao, std::int64_t now_us) {
  if (!aircraft_.contains(icao) && aircraft_.size() >= kMost) {
    aircraft_.erase(std::ranges::min_element(aircraft_, {},
                                             [](const auto& one) { return one.second.heard_us; }));
  }
  Aircraft& found = aircraft_[icao];
  found.heard_us = now_us;
  return found;
}

Readings SbsReader::take(const std::string& line, std::int64_t now_us) {
  constexpr std::int64_t kVelocityLasts_us = 10'000'000;
  const SbsLine sbs(line);
  const std::string& type = sbs.text(SbsLine::kType);
  if (type != "MSG") {
    const bool is_other =
        type == "SEL" || type == "ID" || type == "AIR" || type == "STA" || type == "CLK";
    return is_other ? Readings{} : Readings{Refused{Refusal::kMalformed, "no line of SBS"}};
  }
  const auto icao = sbs.icao();
  if (!icao) return {Refused{Refusal::kMalformed, "no address in a line of SBS"}};
  Aircraft& known = aircraft(*icao, now_us);
  if (const std::string& callsign = sbs.text(SbsLine::kCallsign); !callsign.empty()) {
    known.callsign = callsign.substr(0, kLongestCallsign);
    known.callsign.erase(known.callsign.find_last_not_of(' ') + 1);
  }
  const auto speed_kt = sbs.number(SbsLine::kSpeedKt), track_deg = sbs.number(SbsLine::kTrackDeg);
  if (speed_kt && track_deg) {
    known.velocity_enu_m_s =
        velocity(*speed_kt, *track_deg, sbs.number(SbsLine::kClimbFtMin).value_or(0.0));
    known.velocity_us = now_us;
  }
  const auto latitude = sbs.number(SbsLine::kLatitudeDeg),
             longitude = sbs.number(SbsLine::kLongitudeDeg);
  if (!latitude || !longitude) return {};
  const auto height_ft = sbs.number(SbsLine::kHeightFt);
  if (!height_ft) return {Refused{Refusal::kNoHeight, *icao}};
  Report report;
  report.name = *icao;
  report.label = known.callsign;
  report.utime_us = now_us;
  report.latitude_deg = *latitude;
  report.longitude_deg = *longitude;
  report.height_m = kFoot_m * *height_ft;
  report.is_pressure_height = true;
  if (now_us - known.velocity_us < kVelocityLasts_us) {
    report.velocity_enu_m_s = known.velocity_enu_m_s;
  }
  return {report};
}

}  // namespace ols::cues
