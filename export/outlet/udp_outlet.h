// Sends datagrams to one address or multicast group.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <optional>

#include "export/address.h"
#include "export/outlet/outlet.h"

namespace ols::exports {

class UdpOutlet : public Outlet {
 public:
  explicit UdpOutlet(const Address& address);

  // A datagram that the system cannot send, for lack of room, route or network, is lost and
  // counted.
  void put(Packets packets) override;
  OutletReport report() const override { return report_; }

 private:
  bool open();
  void fail(const boost::system::error_code& why);

  Address address_;
  boost::asio::io_context context_;
  std::optional<boost::asio::ip::udp::socket> socket_;
  OutletReport report_;
  double refused_s_ = -1e9;  // when a refused datagram was last reported
};

}  // namespace ols::exports
