// The master at one end of a serial line.
#pragma once

#include <string>

#include "edge/serial/serial_port.h"
#include "tests/unit/eventually.h"

namespace ols::sim {

// Sends a request; returns whether the bytes received end with this reply. Output from the unit's
// power-up may come before it.
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
