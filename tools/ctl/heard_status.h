// A station's status as received by the operator's programs.
#pragma once

#include <cstddef>
#include <optional>

#include "base/bus_inbox.h"
#include "ols_msg/station_status_t.hpp"

namespace ols::ctl {

// Limits the memory that forged statuses with invented names can use.
inline constexpr std::size_t kMostStationsHeard = 2000;

// Nothing if it is not a status or not from the station of its channel. Its texts are made safe for
// a terminal (base/plain_text.h).
std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message);

}  // namespace ols::ctl
