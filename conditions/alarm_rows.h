// The table of alarms, as compiled in. Pure.
#pragma once

#include <span>

#include "conditions/alarm.h"

namespace ols {

std::span<const AlarmRow> alarm_rows();

}  // namespace ols
