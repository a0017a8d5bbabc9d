#include "sim/onvif/probe_server.h"

#include <boost/asio/ip/multicast.hpp>

#include "sim/onvif/probe_answer.h"

namespace ols::sim {

namespace net = boost::asio;
using net::ip::udp;

ProbeServer::ProbeServer(net::io_context& io, const OnvifConfig& config)
    : config_(config), in_(io), out_(io) {
  const auto own = net::ip::make_address_v4(config.address);
  const auto group = net::ip::make_address_v4("239.255.255.250");
  constexpr unsigned short kPort = 3702;
  in_.open(udp::v4());
  in_.set_option(udp::socket::reuse_address(true));
  in_.bind({group, kPort});
  in_.set_option(net::ip::multicast::join_group(group, own));
  out_.open(udp::v4());
  out_.bind({own, 0});
  receive();
}

void ProbeServer::receive() {
  in_.async_receive_from(
      net::buffer(datagram_), from_, [this](boost::system::error_code error, std::size_t size) {
        if (error == net::error::operation_aborted) return;
        if (const auto answer = probe_answer({datagram_.data(), size}, config_); !error && answer)
          out_.send_to(net::buffer(*answer), from_, 0, error);
        receive();
      });
}

}  // namespace ols::sim
