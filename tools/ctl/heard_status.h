// A station's status as the operator's programs take it from the bus.
#pragma once

#include <cstddef>
#include <optional>

#include "base/bus_inbox.h"
#include "ols_msg/station_status_t.hpp"

namespace ols {

// Names that invented statuses bring must not fill the memory of a program that listens.
inline constexpr std::size_t kMostStationsHeard = 2000;

// Nothing when it is no status, or not that of the station of its channel. Its texts are plain
// (base/plain_text.h): they go to a terminal.
std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message);

}  // namespace ols
