// The serial port on a pseudo-terminal.
#include "edge/serial/serial_port.h"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include <system_error>

namespace ols::serial {
namespace {

class SerialPortTest : public testing::Test {
 protected:
  void SetUp() override {
    char name[128];
    ASSERT_EQ(::openpty(&master_, &slave_, name, nullptr, nullptr), 0);
    device_ = name;
  }
  void TearDown() override {
    if (master_ >= 0) ::close(master_);
    ::close(slave_);
  }
  std::string at_the_other_end() const {
    char bytes[64];
    const auto count = ::read(master_, bytes, sizeof bytes);
    return {bytes, static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
  }
  int master_ = -1, slave_ = -1;
  std::string device_;
};

TEST_F(SerialPortTest, PassesBytesUnchangedBothWays) {
  SerialPort port(device_, 9600);
  port.write("PP \r\n");
  EXPECT_TRUE(port.drain(1.0));
  EXPECT_EQ(at_the_other_end(), "PP \r\n");
  ASSERT_EQ(::write(master_, "* 1\r\n", 5), 5);
  EXPECT_EQ(port.read(1.0), "* 1\r\n");
  EXPECT_EQ(port.read(0.0), "");
}

TEST_F(SerialPortTest, OpensADeviceOnlyOnce) {
  const SerialPort port(device_, 9600);
  EXPECT_THROW(SerialPort(device_, 9600), std::system_error);
}

TEST_F(SerialPortTest, NamesADeviceThatItCannotOpen) {
  for (const char* device : {"/dev/ols-no-such-device", "/dev/null"}) {
    try {
      const SerialPort port(device, 9600);
      ADD_FAILURE() << device;
    } catch (const std::system_error& error) {
      EXPECT_NE(std::string(error.what()).find(device), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(SerialPort(device_, 12345), std::system_error);
}

TEST_F(SerialPortTest, FailsOnceTheDeviceHasVanished) {
  SerialPort port(device_, 9600);
  ::close(std::exchange(master_, -1));
  EXPECT_THROW(port.read(1.0), std::system_error);
}

TEST_F(SerialPortTest, AWakeupEndsTheWaiting) {
  Wakeup wakeup;
  SerialPort port(device_, 9600, Parity::kNone, &wakeup);
  wakeup.set();
  EXPECT_EQ(port.read(3600.0), "");
}

}  // namespace
}  // namespace ols::serial
