// What the answers about the land have in common.
#pragma once

#include <exception>
#include <stdexcept>
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
// The JSON that `made` returns, or why it throws.
template <class Made>
WebResponse land_answer(const Made& made) {
  try {
    return land_said(200, made().dump());
  } catch (const std::invalid_argument& wrong) {
    return land_refused(409, outcome::land_does_not_fit(wrong.what()));
  } catch (const std::exception& wrong) {  // in a thread of its own, where nobody else catches it
    return land_refused(500, outcome::land_does_not_fit(wrong.what()));
  }
}
inline WebResponse no_land() {
  return land_refused(404, outcome::land_does_not_fit("[land] folder is empty"));
}

}  // namespace ols::console
