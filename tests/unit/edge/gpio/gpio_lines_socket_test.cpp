// The socket backend against a server that says whatever the test says.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <system_error>

#include "edge/gpio/gpio_lines.h"
#include "tests/unit/error_text.h"

namespace ols::gpio {
namespace {

using testing::HasSubstr;

class SocketLines : public testing::Test {
 protected:
  SocketLines() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = (std::filesystem::temp_directory_path() /
             ("ols_lines_" + std::string(test->name()) + std::to_string(::getpid())))
                .string();
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    path_.copy(address.sun_path, sizeof address.sun_path - 1);
    listener_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    EXPECT_EQ(::listen(listener_, 1), 0);
    lines_ = open_gpio_lines("socket:" + path_, {{{17}, {18}}, {22}});
    client_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
  }
  ~SocketLines() override {
    hang_up();
    ::close(listener_);
    ::unlink(path_.c_str());
  }

  void say(const std::string& text) const {
    EXPECT_EQ(::send(client_, text.data(), text.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(text.size()));
  }
  std::string hear() const {
    std::array<char, 256> buffer;
    const ssize_t n = ::recv(client_, buffer.data(), buffer.size(), 0);
    return n > 0 ? std::string(buffer.data(), static_cast<std::size_t>(n)) : std::string();
  }
  void hang_up() {
    if (client_ >= 0) ::close(client_);
    client_ = -1;
  }
  std::string error_of_receive() const {
    return error_text<std::system_error>([&] { lines_->receive(); }, "none");
  }

  std::string path_;
  int listener_ = -1, client_ = -1;
  std::unique_ptr<GpioLines> lines_;
};

TEST_F(SocketLines, SpeaksTheProtocol) {
  EXPECT_EQ(hear(), "out 22 0\n");
  lines_->write(22, true);
  EXPECT_EQ(hear(), "out 22 1\n");
  lines_->refresh();
  EXPECT_EQ(hear(), "read 17\nread 18\n");
}

TEST_F(SocketLines, WhatIsNoLevelEndsTheConnection) {
  say("in 17 2\n");
  EXPECT_THAT(error_of_receive(), HasSubstr("sent something that is not a level"));
}

TEST_F(SocketLines, AServerThatIsGone) {
  hang_up();
  EXPECT_THAT(error_of_receive(), HasSubstr("socket:" + path_ + ": has"));
  EXPECT_THROW(lines_->write(22, true), std::system_error);
}

TEST_F(SocketLines, APathThatIsTooLong) {
  EXPECT_THROW(open_gpio_lines("socket:/" + std::string(200, 'x'), {}), std::system_error);
}

}  // namespace
}  // namespace ols::gpio
