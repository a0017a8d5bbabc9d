// Answers programs that search the network for cameras (probe_answer.h), in the thread of an
// io_context.
#pragma once

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>

#include "sim/onvif/config.h"

namespace ols::sim {

class ProbeServer {
 public:
  // Throws boost::system::system_error if the interface of the device's address does not support
  // multicast.
  ProbeServer(boost::asio::io_context& io, const OnvifConfig& config);

 private:
  void receive();

  OnvifConfig config_;
  boost::asio::ip::udp::socket in_, out_;
  boost::asio::ip::udp::endpoint from_;
  std::array<char, 65536> datagram_{};
};

}  // namespace ols::sim
