#include "sim/camera/gige_stream.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

#include "base/process/clocks.h"
#include "sim/camera/gige_registers.h"

namespace ols::sim {
namespace {

constexpr int kDeadline_ms = 20'000;

// The client's end of the stream.
class Client {
 public:
  Client() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in local{};
    local.sin_family = AF_INET;
    local.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof local;
    bind(fd_, reinterpret_cast<sockaddr*>(&local), size);
    getsockname(fd_, reinterpret_cast<sockaddr*>(&local), &size);
    port_ = ntohs(local.sin_port);
  }
  ~Client() { close(fd_); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  StreamSettings settings(double packet_delay_s) const {
    StreamSettings s;
    s.address = htonl(INADDR_LOOPBACK);
    s.port = port_;
    s.packet_size = 1036;  // 1000 bytes of payload
    s.packet_delay_s = packet_delay_s;
    s.width = 100;
    s.height = 100;
    s.format = gige::kMono8;
    return s;
  }

  // The number of the next packet of the frame; -1 when none comes.
  int next() const {
    pollfd ready{.fd = fd_, .events = POLLIN, .revents = 0};
    std::array<std::uint8_t, 2048> packet{};
    if (poll(&ready, 1, kDeadline_ms) <= 0) return -1;
    if (recv(fd_, packet.data(), packet.size(), 0) < 8) return -1;
    return packet[5] << 16 | packet[6] << 8 | packet[7];
  }

 private:
  int fd_;
  std::uint16_t port_ = 0;
};

void send(GigeStream& stream, const StreamSettings& settings) {
  cv::Mat picture = stream.blank(100, 100, CV_8UC1);
  picture.setTo(7);
  stream.send(settings, {.id = 5, .format = settings.format, .width = 100, .height = 100}, picture);
}

TEST(GigeStream, SendsLeaderPayloadAndTrailerInOrder) {
  const Client client;
  GigeStream stream(htonl(INADDR_LOOPBACK));
  send(stream, client.settings(0.0));
  for (int packet = 0; packet < 12; ++packet) EXPECT_EQ(client.next(), packet);
}

TEST(GigeStream, KeepsTheDelayBetweenPackets) {
  const Client client;
  GigeStream stream(htonl(INADDR_LOOPBACK));
  const double begin_s = clock_monotonic_s();
  send(stream, client.settings(0.005));
  for (int packet = 0; packet < 12; ++packet) ASSERT_EQ(client.next(), packet);
  EXPECT_GE(clock_monotonic_s() - begin_s, 11 * 0.005 - 0.004);  // less what it may catch up
}

TEST(GigeStream, LosesItsShareAndSendsAgainOnlyWhenItCan) {
  const Client client;
  GigeStream stream(htonl(INADDR_LOOPBACK));
  send(stream, client.settings(0.0));
  for (int packet = 0; packet < 12; ++packet) ASSERT_EQ(client.next(), packet);
  stream.set_loss(1.0, true);
  stream.resend({.frame = 5, .first = 1, .last = 2});
  stream.set_loss(0.0, false);
  stream.resend({.frame = 5, .first = 3, .last = 4});
  stream.set_loss(0.0, true);
  stream.resend({.frame = 5, .first = 8, .last = 9});
  EXPECT_EQ(client.next(), 8);
  EXPECT_EQ(client.next(), 9);
}

}  // namespace
}  // namespace ols::sim
