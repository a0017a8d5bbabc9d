#include "tools/ctl/heard_status.h"

#include <string>

#include "base/channel_names.h"
#include "base/lcm_bus.h"
#include "base/plain_text.h"

namespace ols::ctl {

std::optional<ols_msg::station_status_t> heard_status(const BusMessage& message) {
  ols_msg::station_status_t status;
  if (!decode_exactly(message, status)) return std::nullopt;
  if (status.schema_version != ols_msg::station_status_t::SCHEMA_VERSION) return std::nullopt;
  // Channel names are printable (base/bus_datagram.h), hence the station's id too.
  if (message.channel != station_channel(kStatusChannel, status.station)) return std::nullopt;
  status.last_error = plain_text(status.last_error);
  for (auto* texts : {&status.device_name, &status.device_text, &status.alarm, &status.reading_name,
                      &status.counter_name}) {
    for (std::string& text : *texts) text = plain_text(text);
  }
  return status;
}

}  // namespace ols::ctl
