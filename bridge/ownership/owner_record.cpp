#include "bridge/ownership/owner_record.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace ols::bridge {
namespace {

using Json = nlohmann::json;

constexpr double kLargest_m = 1e9;

bool is_place(const Vector& vector) {
  return std::ranges::all_of(
      vector, [](double value) { return std::isfinite(value) && std::abs(value) < kLargest_m; });
}

}  // namespace

std::string to_text(const OwnerRecord& record) {
  return Json{{"owner", record.owner},
              {"successor", record.successor},
              {"beat", record.beat},
              {"utime", record.utime_us},
              {"position_m", record.position_m},
              {"velocity_m_s", record.velocity_m_s},
              {"sd_m", record.sd_m}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<OwnerRecord> parse_record(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    OwnerRecord record;
    record.owner = json.at("owner").get<std::string>();
    record.successor = json.at("successor").get<std::string>();
    record.beat = json.at("beat").get<std::int64_t>();
    record.utime_us = json.at("utime").get<std::int64_t>();
    record.position_m = json.at("position_m").get<Vector>();
    record.velocity_m_s = json.at("velocity_m_s").get<Vector>();
    record.sd_m = json.at("sd_m").get<double>();
    const bool is_good = is_place(record.position_m) && is_place(record.velocity_m_s) &&
                         std::isfinite(record.sd_m) && record.sd_m >= 0.0;
    if (!is_good) return std::nullopt;
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace ols::bridge
