#include "export/outlet/mqtt_link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace ols::exports {
namespace {

// A broker that takes the log-in, and then reads a little now and then, for as long as there is
// something.
class SlowBroker {
 public:
  static constexpr std::size_t kAtOnce = 1 << 16;
  static constexpr auto kPause = std::chrono::milliseconds(40);

  SlowBroker() : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    auto* const name = reinterpret_cast<sockaddr*>(&here);
    EXPECT_EQ(::bind(listener_, name, size), 0);
    EXPECT_EQ(::listen(listener_, 5), 0);
    EXPECT_EQ(::getsockname(listener_, name, &size), 0);
    port = ntohs(here.sin_port);
    reader_ = std::thread([this] { serve(); });
  }
  ~SlowBroker() {
    ends_ = true;
    ::shutdown(listener_, SHUT_RDWR);
    reader_.join();
    ::close(listener_);
  }
  SlowBroker(const SlowBroker&) = delete;
  SlowBroker& operator=(const SlowBroker&) = delete;

  int port = 0;

 private:
  // The link looks by a connection of its own first whether anybody is there.
  void serve() {
    for (int client = -1; (client = ::accept(listener_, nullptr, nullptr)) >= 0;) {
      read(client);
      ::close(client);
    }
  }
  void read(int client) {
    std::vector<char> bytes(kAtOnce);
    constexpr std::array<unsigned char, 4> kTaken{0x20, 2, 0, 0};
    bool is_first = true;
    while (!ends_ && ::recv(client, bytes.data(), bytes.size(), 0) > 0) {
      if (std::exchange(is_first, false))
        ::send(client, kTaken.data(), kTaken.size(), MSG_NOSIGNAL);
      std::this_thread::sleep_for(kPause);
    }
  }

  int listener_;
  std::atomic<bool> ends_{false};
  std::thread reader_;
};

TEST(MqttLink, ABrokerThatReadsALittleNowAndThenIsLeft) {
  SlowBroker broker;
  Address address;
  address.scheme = Scheme::kMqtt;
  address.host = std::string("127.0.0.1");
  address.port = broker.port;
  MqttLink link(address, {}, {"test", "", "", "ols/status"});
  link.open();
  link.send({"target", "short", "ols/target/1"});
  // More than the kernel takes, and than the broker reads while we are patient.
  const std::string lengthy(40'000'000, 'x');
  try {
    link.send({"target", lengthy, "ols/target/1"});
    ADD_FAILURE() << "it has waited for all of it to be read";
  } catch (const LinkError& error) {
    EXPECT_EQ(std::string(error.what()), "127.0.0.1: does not read");
  }
}

}  // namespace
}  // namespace ols::exports
