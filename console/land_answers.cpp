#include "console/land_answers.h"

#include <stdexcept>
#include <utility>

#include "conditions/alarm_json.h"
#include "conditions/sayings.h"

namespace ols::console {
namespace {

WebResponse refused(int status, const std::string& why) {
  const Outcome refusal = outcome::land_does_not_fit(why);
  return land_said(status, Json{{"error", refusal.text}, {"refusal", refusal}}.dump());
}

}  // namespace

WebResponse land_said(int status, std::string json) {
  return {status, "application/json", std::move(json), {}};
}

WebResponse no_land() { return refused(404, "[land] folder is empty"); }

WebResponse land_answer(const std::function<Json()>& made) {
  try {
    return land_said(200, made().dump());
  } catch (const std::invalid_argument& wrong) {
    return refused(409, wrong.what());
  } catch (const std::exception& wrong) {  // in its own thread, nobody else would catch it
    return refused(500, wrong.what());
  }
}

}  // namespace ols::console
