// Receives a stream from a TCP server. Reconnects by itself.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <vector>

#include "cue/inlet/inlet.h"
#include "export/back_off.h"

namespace ols::cues {

class TcpInlet : public Inlet {
 public:
  TcpInlet(boost::asio::io_context& context, Source source, InletSink sink);

 private:
  void open();
  void connect(const boost::asio::ip::tcp::resolver::results_type& found);
  void connected();
  void listen();
  void fail(const std::string& why);
  // Ends the connection attempt if it takes too long.
  void give_patience();

  Source source_;
  InletSink sink_;
  boost::asio::ip::tcp::resolver resolver_;
  boost::asio::ip::tcp::socket socket_;
  boost::asio::steady_timer timer_;
  exports::BackOff back_off_;
  std::vector<char> buffer_;
};

}  // namespace ols::cues
