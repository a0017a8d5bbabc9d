// What the answers about the land have in common.
#pragma once

#include <functional>
#include <string>

#include "console/entity_table.h"
#include "console/web_api.h"

namespace ols::console {

WebResponse land_said(int status, std::string json);
// [land] is not configured.
WebResponse no_land();
// The JSON that `made` returns, or why it throws.
WebResponse land_answer(const std::function<Json()>& made);

}  // namespace ols::console
