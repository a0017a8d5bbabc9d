// HTTP responses about the land, for LandSkylines and SiteLand.
#pragma once

#include <functional>
#include <string>

#include "console/entity_table.h"
#include "console/web_api.h"

namespace ols::console {

WebResponse land_said(int status, std::string json);
// The response if [land] is not configured.
WebResponse no_land();
// The response with the JSON that `made` returns; if `made` throws, with the reason.
WebResponse land_answer(const std::function<Json()>& made);

}  // namespace ols::console
