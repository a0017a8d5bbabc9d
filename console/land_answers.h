// What the answers about the land have in common.
#pragma once

#include <string>
#include <utility>

#include "conditions/alarm_json.h"
#include "conditions/sayings.h"
#include "console/web_api.h"

namespace ols::console {

inline WebResponse land_said(int status, std::string json) {
  return {status, "application/json", std::move(json), {}};
}
inline WebResponse land_refused(int status, const Outcome& why) {
  return land_said(status, Json{{"error", why.text}, {"refusal", why}}.dump());
}
inline WebResponse no_land() {
  return land_refused(404, outcome::land_does_not_fit("[land] folder is empty"));
}

}  // namespace ols::console
