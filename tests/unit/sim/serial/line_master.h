// A master at the end of a line.
#pragma once

#include <string>

#include "edge/serial/serial_port.h"
#include "tests/unit/eventually.h"

namespace ols::sim {

// Whether it hears this reply at last: what the unit said at power-up may still be on the line.
inline bool answers(serial::SerialPort& port, const std::string& request,
                    const std::string& reply) {
  port.write(request);
  std::string heard;
  return eventually([&] {
    heard += port.read(0.01);
    return heard.ends_with(reply);
  });
}

}  // namespace ols::sim
