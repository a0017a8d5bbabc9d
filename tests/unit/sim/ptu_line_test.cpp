#include "sim/ptu_line.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <system_error>
#include <thread>

#include "edge/serial/serial_port.h"
#include "tests/unit/sim/ptu_master.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

constexpr std::chrono::seconds kDeadline(10);

bool soon(const auto& condition) {
  const auto end = std::chrono::steady_clock::now() + kDeadline;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::yield();
  }
  return true;
}

// What the unit said at power-up may still be on the line.
bool answers(serial::SerialPort& port, const std::string& request, const std::string& reply) {
  port.write(request);
  std::string heard;
  return soon([&] {
    heard += port.read(0.01);
    return heard.ends_with(reply);
  });
}

TEST(PtuLine, VanishesAndComesBackUnderItsLink) {
  const std::string link = temp_dir() + "ols_ptu_line_" + std::to_string(::getpid());
  PtuLine line(ready_unit(), 1, link);
  serial::SerialPort before(link, 9600);
  PtuFaults gone;
  gone.line_gone = true;
  line.set_faults(gone);
  ASSERT_TRUE(soon([&] { return line.device().empty(); }));
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
  EXPECT_THROW(while (true) before.read(0.01), std::system_error);
  line.set_faults({});
  ASSERT_TRUE(soon([&] { return !line.device().empty(); }));
  serial::SerialPort after(link, 9600);
  EXPECT_TRUE(answers(after, "PX ", "* 49467\r\n"));
}

TEST(PtuLine, IsFollowedToItsNewRate) {
  PtuLine line(ready_unit(), 1);
  EXPECT_TRUE(answers(*std::make_unique<serial::SerialPort>(line.device(), 9600), "@(38400,0,F) ",
                      "*\r\n"));
  serial::SerialPort port(line.device(), 38400);
  EXPECT_TRUE(answers(port, " PX ", "* 49467\r\n"));
}

}  // namespace
}  // namespace ols::sim
