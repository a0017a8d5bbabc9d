// The keys of [inclinometer] with a DPG2.
#include "edge/sensors/dpg2/dpg2_kind.h"

#include <algorithm>
#include <iterator>

namespace ols::sensors {

config::Section Dpg2Kind::section() {
  config::Section section{
      "inclinometer",
      "",
      {config::text("device", dpg2.device, "Serial device; empty: none.").required_with_section(),
       config::one_of("baud", dpg2.baud, {600, 1200, 2400, 4800, 9600, 19200, 38400, 57600, 115200},
                      "baud", "Rate of the serial line."),
       config::word("parity", dpg2.even_parity, {{"none", false}, {"even", true}},
                    "Parity of the serial line; the BEI and AGS variants use even (8E1).")}};
  std::ranges::move(inclinometer_rows(dpg2), std::back_inserter(section.rows));
  return section;
}

std::string Dpg2Kind::address() const {
  return dpg2.device + " at " + std::to_string(dpg2.baud) + " baud";
}

}  // namespace ols::sensors
