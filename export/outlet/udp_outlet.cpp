#include "export/outlet/udp_outlet.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/multicast.hpp>

#include "base/process/clocks.h"

namespace ols::exports {

namespace ip = boost::asio::ip;

namespace {

constexpr double kRefusal_s = 3.0;  // for so long after a refusal, nobody seems to listen

}  // namespace

UdpOutlet::UdpOutlet(const Address& address) : address_(address) {}

// Opened when it is first used, and again after the network was gone: the route is looked up then.
bool UdpOutlet::open() {
  if (socket_) return true;
  boost::system::error_code bad;
  const ip::address to = ip::make_address(address_.host);
  const ip::udp::endpoint endpoint(to, static_cast<std::uint16_t>(address_.port));
  socket_.emplace(context_);
  static_cast<void>(socket_->open(endpoint.protocol(), bad));
  if (!bad && to.is_multicast()) {
    static_cast<void>(socket_->set_option(ip::multicast::hops(address_.ttl), bad));
    if (!bad && !address_.interface.empty() && to.is_v4()) {
      static_cast<void>(socket_->set_option(
          ip::multicast::outbound_interface(ip::make_address_v4(address_.interface)), bad));
    }
  }
  if (!bad) static_cast<void>(socket_->connect(endpoint, bad));
  if (!bad) static_cast<void>(socket_->non_blocking(true, bad));
  if (bad) {
    fail(bad);
    return false;
  }
  ++report_.openings;
  return true;
}

void UdpOutlet::fail(const boost::system::error_code& why) {
  ++report_.failures;
  report_.is_open = false;
  report_.trouble = why.message();
  socket_.reset();
}

void UdpOutlet::put(Packets packets) {
  for (const Packet& packet : packets) {
    if (!open()) continue;
    boost::system::error_code bad;
    const auto send = [&] { return socket_->send(boost::asio::buffer(packet.bytes), 0, bad); };
    std::size_t bytes = send();
    // An earlier datagram was refused; this one has not been sent yet.
    if (bad == boost::asio::error::connection_refused) {
      refused_s_ = clock_monotonic_s();
      ++report_.failures;
      bytes = send();
    }
    if (bad == boost::asio::error::would_block || bad == boost::asio::error::no_buffer_space) {
      ++report_.displaced;
    } else if (bad && bad != boost::asio::error::connection_refused) {
      fail(bad);
    } else {
      report_.is_open = true;
      // A system reports only some of the datagrams that it refuses.
      const bool is_heard = clock_monotonic_s() - refused_s_ > kRefusal_s;
      report_.trouble = is_heard ? "" : "nobody listens there";
      report_.sent += bad ? 0 : 1;
      report_.bytes += bad ? 0 : bytes;
    }
  }
}

}  // namespace ols::exports
