// The keys of [gnss] with gpsd.
#include "edge/sensors/gpsd/gpsd_kind.h"

#include <algorithm>
#include <iterator>

namespace ols::sensors {

config::Section GpsdKind::section() {
  config::Section section{
      "gnss",
      "",
      {config::text("host", gpsd.host, "Host of gpsd; empty: no receiver.").required_with_section(),
       config::integer_row(
           "port", std::stoi(gpsd.port), 1, 65535, "",
           [this](std::int64_t port) { gpsd.port = std::to_string(port); }, "Port of gpsd."),
       config::number("error_sigmas", gpsd.error_sigmas, {0.5, 3.0}, "sigma",
                      "What gpsd's own error estimate means; used where the receiver sends no "
                      "GST.")}};
  std::ranges::move(gnss_rows(gpsd), std::back_inserter(section.rows));
  return section;
}

}  // namespace ols::sensors
