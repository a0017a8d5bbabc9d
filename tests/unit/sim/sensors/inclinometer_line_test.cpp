#include "sim/sensors/inclinometer_line.h"

#include <gtest/gtest.h>

#include "edge/serial/serial_port.h"
#include "geometry/angles.h"
#include "tests/unit/eventually.h"

namespace ols::sim {
namespace {

TEST(Dpg2Lines, AreThoseOfTheManual) {
  EXPECT_EQ(dpg2_lines(radians(0.430), radians(-0.084)), "X=+00.430\r\nY=-00.084\r\n");
  EXPECT_EQ(dpg2_lines(radians(-12.3456), 0.0), "X=-12.346\r\nY=+00.000\r\n");
}

InclinometerLineConfig still() {
  InclinometerLineConfig c;
  c.tilt_x_rad = radians(0.430);
  c.tilt_y_rad = radians(-0.084);
  return c;
}

bool says(serial::SerialPort& port, const std::string& text) {
  std::string heard;
  return eventually([&] {
    heard += port.read(0.02);
    return heard.find(text) != std::string::npos;
  });
}

TEST(InclinometerLine, StreamsFromPowerUpAndObeysItsCommands) {
  const InclinometerLine line(still(), 1);
  serial::SerialPort port(line.device(), 9600);
  EXPECT_TRUE(says(port, "X=+00.430\r\nY=-00.084\r\nX=+00.430\r\n"));
  port.write("sV");
  EXPECT_TRUE(says(port, "DPG2 V1.4\r\n"));
  // All that was on the way has been read: what comes now is the answer to R alone.
  port.write("R");
  std::string heard;
  EXPECT_TRUE(eventually([&] {
    heard += port.read(0.02);
    return heard.size() >= 22;
  }));
  EXPECT_EQ(heard, "X=+00.430\r\nY=-00.084\r\n");
  port.write("S");
  EXPECT_TRUE(says(port, "Y=-00.084\r\nX=+00.430\r\n"));
}

}  // namespace
}  // namespace ols::sim
