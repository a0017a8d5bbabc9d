#include "tools/calibrate/session_options.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

namespace ols::calibration {
namespace {

using Json = nlohmann::ordered_json;

Json value_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

std::optional<double> number_of(const Json& value) {
  return value.is_null() ? std::nullopt : std::optional(value.get<double>());
}

}  // namespace

std::string session_text(const ProcedureOptions& o) {
  const Json object{{"procedure", o.name},
                    {"references", o.references},
                    {"instrument", o.instrument},
                    {"sweep_poses", o.sweep_poses},
                    {"rounds", o.rounds},
                    {"stars", o.stars},
                    {"sun", o.sun},
                    {"overcast", o.overcast},
                    {"drone", o.drone},
                    {"drone_points", o.drone_points},
                    {"ut1_utc_s", value_of(o.ut1.minus_utc_s)},
                    {"ut1_date", o.ut1.date},
                    {"pressure_hPa", value_of(o.pressure_hPa)},
                    {"temperature_degC", value_of(o.temperature_degC)}};
  return object.dump(2) + "\n";
}

ProcedureOptions resumed_options(const std::string& text, const ProcedureOptions& now,
                                 const std::string& path) {
  ProcedureOptions o = now;
  std::string procedure;
  try {
    const Json object = Json::parse(text);
    procedure = object.at("procedure").get<std::string>();
    o.references = object.at("references").get<std::string>();
    o.instrument = object.at("instrument").get<std::string>();
    o.sweep_poses = object.at("sweep_poses").get<int>();
    o.rounds = object.at("rounds").get<int>();
    o.stars = object.at("stars").get<int>();
    o.sun = object.at("sun").get<bool>();
    o.overcast = object.at("overcast").get<bool>();
    o.drone = object.at("drone").get<std::string>();
    o.drone_points = object.at("drone_points").get<int>();
    o.ut1 = {number_of(object.at("ut1_utc_s")), object.value("ut1_date", "")};
    o.pressure_hPa = number_of(object.at("pressure_hPa"));
    o.temperature_degC = number_of(object.at("temperature_degC"));
  } catch (const nlohmann::json::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
  if (procedure != now.name) {
    throw std::runtime_error(path + ": is of `" + procedure + "`, not of `" + now.name + "`");
  }
  return o;
}

}  // namespace ols::calibration
