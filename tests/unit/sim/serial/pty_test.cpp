#include "sim/serial/pty.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <system_error>

#include "tests/unit/temp_dir.h"

namespace ols::sim {
namespace {

constexpr double kDeadline_s = 10.0;

class Client {
 public:
  explicit Client(const std::string& device) : fd_(::open(device.c_str(), O_RDWR | O_NOCTTY)) {}
  ~Client() { ::close(fd_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void write(const std::string& bytes) const {
    EXPECT_EQ(::write(fd_, bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  std::string read() const {
    pollfd entry{fd_, POLLIN, 0};
    ::poll(&entry, 1, static_cast<int>(1e3 * kDeadline_s));
    std::array<char, 64> buffer;
    const ssize_t n = ::read(fd_, buffer.data(), buffer.size());
    return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : "hung up";
  }

 private:
  int fd_;
};

std::string heard(Pty& pty) {
  pty.wait(kDeadline_s);
  return pty.read();
}

std::string link_path() { return temp_dir() + "ols_pty_" + std::to_string(::getpid()); }

TEST(Pty, CarriesEveryByteBothWays) {
  Pty pty;
  const Client client(pty.device());
  const std::string bytes("\x03\r\n\x11\x7f\xff*", 7);  // what a terminal that is not raw eats
  client.write(bytes);
  EXPECT_EQ(heard(pty), bytes);
  pty.write(bytes);
  EXPECT_EQ(client.read(), bytes);
}

TEST(Pty, OutlivesItsClients) {
  Pty pty;
  { const Client first(pty.device()); }
  const Client second(pty.device());
  second.write("PP ");
  EXPECT_EQ(heard(pty), "PP ");
}

TEST(Pty, ComesBackAsANewDeviceUnderItsLink) {
  const std::string link = link_path();
  {
    Pty pty(link);
    const Client before(link);
    pty.unplug();
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
    EXPECT_EQ(before.read(), "hung up");
    EXPECT_EQ(pty.read(), "");
    pty.write("lost");
    pty.unplug();
    EXPECT_EQ(pty.device(), "");
    pty.plug();
    const Client after(link);
    pty.write("* 0\r\n");
    EXPECT_EQ(after.read(), "* 0\r\n");
    EXPECT_EQ(before.read(), "hung up");
  }
  EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
}

TEST(Pty, ReplacesALinkButNothingElse) {
  const std::string link = link_path();
  std::filesystem::create_symlink("/nonexistent", link);
  const Pty pty(link);
  EXPECT_EQ(std::filesystem::read_symlink(link), pty.device());
  EXPECT_THROW(Pty("/dev/null"), std::system_error);
}

}  // namespace
}  // namespace ols::sim
