#include "sim/lens/lens_line.h"

#include <gtest/gtest.h>

#include "base/process/clocks.h"
#include "edge/serial/serial_port.h"
#include "tests/unit/eventually.h"

namespace ols::sim {
namespace {

TEST(LensLine, AnswersOnItsTerminal) {
  const LensLine line(LensUnitConfig{.start_zoom = 0.25});
  serial::SerialPort port(line.device(), 9600);
  port.write(std::string("\x81\x09\x04\x47\xff"));
  std::string heard;
  EXPECT_TRUE(eventually([&] {
    heard += port.read(0.02);
    return heard == std::string("\x90\x50\x01\x00\x00\x00\xff", 7);
  }));
  EXPECT_NEAR(line.zoom_at(clock_monotonic_s()), 0.25, 1e-9);
}

}  // namespace
}  // namespace ols::sim
