// Reads a file that its source rewrites again and again, on this host or on a web server. The file
// is read periodically, and passed on if it has changed.
#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <optional>
#include <string>

#include "cue/inlet/inlet.h"

namespace ols::cues {

class PollInlet : public Inlet {
 public:
  PollInlet(boost::asio::io_context& context, Source source, double poll_s, InletSink sink);

 private:
  using Response = boost::beast::http::response_parser<boost::beast::http::string_body>;
  void look();
  void look_again(std::chrono::milliseconds after);
  void read_file();
  void ask();
  void connect(const boost::asio::ip::tcp::resolver::results_type& found);
  void send();
  void take(const std::string& text);
  void fail(const std::string& why);

  Source source_;
  std::chrono::milliseconds poll_;
  InletSink sink_;
  boost::asio::ip::tcp::resolver resolver_;
  boost::beast::tcp_stream stream_;
  boost::asio::steady_timer timer_;
  boost::beast::http::request<boost::beast::http::empty_body> request_;
  boost::beast::flat_buffer buffer_;
  std::optional<Response> response_;
  std::string last_;
};

}  // namespace ols::cues
