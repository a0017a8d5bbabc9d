// The alarms of conditions.toml, compiled into the program. Pure.
#pragma once

#include <span>

#include "conditions/alarm.h"

namespace ols {

std::span<const AlarmRow> alarm_rows();

}  // namespace ols
