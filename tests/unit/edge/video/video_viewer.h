// A client of a station's video socket, for tests.
#pragma once

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/net/length_prefix.h"
#include "ols_msg/video_frame_t.hpp"
#include "ols_msg/video_request_t.hpp"
#include "tests/unit/on_the_bus.h"

namespace ols::video {

// A port of the loopback that was free just now.
inline unsigned short free_port() {
  boost::asio::io_context io;
  boost::asio::ip::tcp::acceptor probe(io, {boost::asio::ip::make_address("127.0.0.1"), 0});
  return probe.local_endpoint().port();
}

class Viewer {
 public:
  explicit Viewer(unsigned short port) : socket_(io_) {
    boost::system::error_code error;
    socket_.connect({boost::asio::ip::make_address("127.0.0.1"), port}, error);
    connected_ = !error;
  }

  bool connected() const { return connected_; }

  void ask(std::int64_t after_utime = 0, int max_width_px = 640) {
    auto message = made<ols_msg::video_request_t>();
    message.after_utime = after_utime;
    message.max_width_px = max_width_px;
    message.quality = 80;
    const auto bytes = encoded(message);
    send(length_prefix(static_cast<std::uint32_t>(bytes.size())));
    send(bytes);
  }

  template <typename Bytes>
  void send(const Bytes& bytes) {
    boost::system::error_code error;
    boost::asio::write(socket_, boost::asio::buffer(bytes), error);
  }

  // Waits for a frame; nullopt: the station has closed the connection.
  std::optional<ols_msg::video_frame_t> receive() {
    LengthPrefix prefix;
    boost::system::error_code error;
    boost::asio::read(socket_, boost::asio::buffer(prefix), error);
    if (error) return std::nullopt;
    std::vector<std::uint8_t> bytes(message_length(prefix, 1U << 24U).value_or(0));
    boost::asio::read(socket_, boost::asio::buffer(bytes), error);
    ols_msg::video_frame_t message;
    const auto size = static_cast<int>(bytes.size());
    if (error || message.decode(bytes.data(), 0, size) != size) return std::nullopt;
    return message;
  }

 private:
  boost::asio::io_context io_;
  boost::asio::ip::tcp::socket socket_;
  bool connected_ = false;
};

}  // namespace ols::video
