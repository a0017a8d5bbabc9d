#include "base/process/service_notifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace ols {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

// The service manager's end of the socket.
class ServiceManager : public testing::Test {
 protected:
  void SetUp() override {
    path_ = std::filesystem::temp_directory_path() / ("notify-" + std::to_string(getpid()));
    socket_ = socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path_.c_str(), sizeof address.sun_path - 1);
    unlink(path_.c_str());
    ASSERT_EQ(bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    setenv("NOTIFY_SOCKET", path_.c_str(), 1);
  }
  void TearDown() override {
    for (const char* name : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(name);
    close(socket_);
    unlink(path_.c_str());
  }
  // What has arrived: a datagram sent on this host is there when the sender returns.
  std::vector<std::string> heard() const {
    std::vector<std::string> messages;
    std::array<char, 512> buffer{};
    for (;;) {
      const ssize_t bytes = recv(socket_, buffer.data(), buffer.size(), 0);
      if (bytes < 0) return messages;
      messages.emplace_back(buffer.data(), static_cast<std::size_t>(bytes));
    }
  }

 private:
  std::filesystem::path path_;
  int socket_ = -1;
};

TEST_F(ServiceManager, HearsThatTheProcessServesAndWhatItDoes) {
  ServiceNotifier notifier;
  notifier.ready("camera absent");
  notifier.status("camera absent");
  notifier.status("all is well\nMAINPID=1");
  notifier.stopping();
  EXPECT_THAT(heard(), ElementsAre("READY=1\nSTATUS=camera absent", "STATUS=all is well MAINPID=1",
                                   "STOPPING=1"));
}

TEST_F(ServiceManager, HearsTheWatchdogFourTimesInItsIntervalHoweverFastTheLoopTurns) {
  setenv("WATCHDOG_USEC", "4000000", 1);
  ServiceNotifier notifier;
  for (int i = 0; i <= 300; ++i) notifier.alive(100.0 + 0.01 * i);
  EXPECT_EQ(heard().size(), 4U);  // at 100, 101, 102 and 103 s
}

TEST_F(ServiceManager, HearsNoWatchdogThatItDidNotAskFor) {
  ServiceNotifier notifier;
  notifier.alive(1.0);
  setenv("WATCHDOG_USEC", "4000000", 1);
  setenv("WATCHDOG_PID", "1", 1);  // meant for another process
  ServiceNotifier inherited;
  inherited.alive(1.0);
  EXPECT_THAT(heard(), IsEmpty());
}

}  // namespace
}  // namespace ols
