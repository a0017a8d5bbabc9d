#include "tools/calibrate/session_options.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ols::calibration {
namespace {

using Json = nlohmann::ordered_json;

// Passes each option that a resumed procedure has again, with its key.
void each_kept(auto& o, const auto& pass) {
  pass("references", o.references);
  pass("instrument", o.instrument);
  pass("sweep_poses", o.sweep_poses);
  pass("rounds", o.rounds);
  pass("stars", o.stars);
  pass("sun", o.sun);
  pass("overcast", o.overcast);
  pass("drone", o.drone);
  pass("drone_points", o.drone_points);
  pass("ut1_utc_s", o.ut1.minus_utc_s);
  pass("ut1_date", o.ut1.date);
  pass("pressure_hPa", o.pressure_hPa);
  pass("temperature_degC", o.temperature_degC);
}

template <class T>
Json json_of(const T& value) {
  return value;
}
Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

template <class T>
void read(const Json& json, T& value) {
  value = json.get<T>();
}
void read(const Json& json, std::optional<double>& value) {
  value = json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

}  // namespace

std::string session_text(const ProcedureOptions& o) {
  Json object{{"procedure", o.name}};
  each_kept(o, [&](const char* key, const auto& value) { object[key] = json_of(value); });
  return object.dump(2) + "\n";
}

ProcedureOptions resumed_options(const std::string& text, const ProcedureOptions& now,
                                 const std::string& path) {
  ProcedureOptions o = now;
  std::string procedure;
  try {
    const Json object = Json::parse(text);
    procedure = object.at("procedure").get<std::string>();
    each_kept(o, [&](const std::string& key, auto& value) {
      // Sessions of earlier versions have no date.
      if (key == "ut1_date" && !object.contains(key)) return;
      read(object.at(key), value);
    });
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  if (procedure != now.name) {
    throw std::runtime_error(path + ": is of `" + procedure + "`, not of `" + now.name + "`");
  }
  return o;
}

}  // namespace ols::calibration
