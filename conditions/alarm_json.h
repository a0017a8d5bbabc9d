// An alarm as JSON, for a program's status file: {"text", "id", "parameters": {name: value}}. Pure.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "conditions/alarm.h"

namespace ols {

template <class Json>
void to_json(Json& json, const Alarm& alarm) {
  Json parameters = Json::object();
  for (const auto& [name, value] : alarm.parameters) parameters[name] = value;
  json = {{"text", alarm.text}, {"id", alarm.id}, {"parameters", std::move(parameters)}};
}

template <class Json>
void from_json(const Json& json, Alarm& alarm) {
  alarm.text = json.at("text").template get<std::string>();
  alarm.id = json.at("id").template get<std::string>();
  for (const auto& [name, value] : json.at("parameters").items()) {
    alarm.parameters.emplace_back(name, value.template get<std::string>());
  }
}

}  // namespace ols
