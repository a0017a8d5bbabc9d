#include "cue/inlet/udp_inlet.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/ip/multicast.hpp>
#include <chrono>
#include <utility>

namespace ols::cues {

namespace ip = boost::asio::ip;

namespace {

constexpr std::chrono::seconds kOpenAgain{1}, kJoinAgain{10};

}  // namespace

UdpInlet::UdpInlet(boost::asio::io_context& context, Source source, InletSink sink)
    : source_(std::move(source)),
      sink_(std::move(sink)),
      socket_(context),
      timer_(context),
      buffer_(65'536) {
  open();
}

// A group's port may have several listeners on one host.
boost::system::error_code UdpInlet::bind() {
  boost::system::error_code bad;
  const ip::address at = ip::make_address(source_.host, bad);
  if (bad) return bad;
  const ip::udp::endpoint endpoint(at, static_cast<std::uint16_t>(source_.port));
  static_cast<void>(socket_.open(endpoint.protocol(), bad));
  if (!bad && at.is_multicast()) {
    static_cast<void>(socket_.set_option(ip::udp::socket::reuse_address(true), bad));
  }
  if (!bad) static_cast<void>(socket_.bind(endpoint, bad));
  if (bad || !at.is_multicast()) return bad;
  if (at.is_v4() && !source_.interface.empty()) {
    const ip::address_v4 by = ip::make_address_v4(source_.interface);
    static_cast<void>(socket_.set_option(ip::multicast::join_group(at.to_v4(), by), bad));
  } else {
    static_cast<void>(socket_.set_option(ip::multicast::join_group(at), bad));
  }
  return bad;
}

void UdpInlet::open() {
  if (const auto bad = bind()) return fail(bad.message());
  opened();
  sink_.begins();
  listen();
  join_again_when_silent();
}

// Membership of a group ends silently when the network device goes through which it was joined.
void UdpInlet::join_again_when_silent() {
  if (!ip::make_address(source_.host).is_multicast()) return;
  timer_.expires_after(kJoinAgain);
  timer_.async_wait([this](const boost::system::error_code& bad) {
    if (bad) return;
    if (std::exchange(heard_, false)) return join_again_when_silent();
    close();
    open();
  });
}

void UdpInlet::close() {
  boost::system::error_code ignored;
  static_cast<void>(socket_.close(ignored));
}

void UdpInlet::listen() {
  socket_.async_receive(boost::asio::buffer(buffer_),
                        [this](const boost::system::error_code& bad, std::size_t bytes) {
                          if (bad == boost::asio::error::operation_aborted) return;
                          if (bad) return fail(bad.message());
                          heard_ = true;
                          received(sink_, {buffer_.data(), bytes});
                          listen();
                        });
}

void UdpInlet::fail(const std::string& why) {
  close();
  failed(why);
  timer_.expires_after(kOpenAgain);
  timer_.async_wait([this](const boost::system::error_code& bad) {
    if (!bad) open();
  });
}

}  // namespace ols::cues
