#include "sim/ptu/line.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "tests/unit/eventually.h"
#include "tests/unit/sim/ptu/master.h"
#include "tests/unit/sim/serial/line_master.h"
#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

TEST(PtuLine, VanishesAndComesBackUnderItsLink) {
  const std::string link = temp_dir() + "ols_ptu_line_" + std::to_string(::getpid());
  PtuLine line(ready_unit(), 1, link);
  serial::SerialPort before(link, 9600);
  PtuFaults gone;
  gone.line_gone = true;
  line.set_faults(gone);
  ASSERT_TRUE(eventually([&] { return line.device().empty(); }));
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
  EXPECT_THROW(while (true) before.read(0.01), std::system_error);
  line.set_faults({});
  ASSERT_TRUE(eventually([&] { return !line.device().empty(); }));
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
