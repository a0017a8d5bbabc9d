// Receives datagrams that are sent to this host or to a multicast group. Joins a group again after
// ten seconds without a datagram.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/udp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <vector>

#include "cue/inlet/inlet.h"

namespace ols::cues {

class UdpInlet : public Inlet {
 public:
  UdpInlet(boost::asio::io_context& context, Source source, InletSink sink);

 private:
  void open();
  void listen();
  void join_again_when_silent();
  void close();
  void fail(const std::string& why);
  boost::system::error_code bind();

  Source source_;
  InletSink sink_;
  boost::asio::ip::udp::socket socket_;
  boost::asio::steady_timer timer_;
  std::vector<char> buffer_;
  bool heard_ = false;  // whether a datagram has come since the last check
};

}  // namespace ols::cues
