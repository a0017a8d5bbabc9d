// A browser's WebSocket: receives the browser's messages, and sends it whatever is new, one message
// at a time.
#pragma once

#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "base/process/clocks.h"
#include "console/connection_limit.h"
#include "console/web_api.h"

namespace ols::console {

inline constexpr int kMostMessages_s = 100;
inline constexpr auto kPatience = std::chrono::seconds(20);

inline Now clock_now() { return {clock_monotonic_s(), clock_utime_us()}; }

class Live {
 public:
  virtual ~Live() = default;
  virtual void pump() = 0;
};

// `Shared`: the part of the server that all connections share, with api, console and the list of
// live sockets.
template <class Stream, class Shared>
class LiveSocket : public Live, public std::enable_shared_from_this<LiveSocket<Stream, Shared>> {
 public:
  LiveSocket(Stream&& stream, Shared& shared, Session session, std::string token,
             ConnectionLimit::Place place)
      : ws_(std::move(stream)),
        shared_(shared),
        session_(std::move(session)),
        token_(std::move(token)),
        place_(std::move(place)) {}
  ~LiveSocket() override {
    if (viewer_ != 0) shared_.console.close(viewer_);
  }

  void start(boost::beast::http::request<boost::beast::http::string_body> request) {
    request_ = std::move(request);
    boost::beast::get_lowest_layer(ws_).expires_never();
    ws_.set_option(boost::beast::websocket::stream_base::timeout{kPatience, kPatience, true});
    ws_.read_message_max(kMostMessageBytes);
    ws_.async_accept(request_, [self = this->shared_from_this()](boost::beast::error_code error) {
      if (!error) self->opened();
    });
  }

  void pump() override {
    if (viewer_ == 0) return;
    if (!is_logged_in()) return end();
    if (is_writing_) return;
    auto next = shared_.console.next(viewer_, clock_now());
    if (!next) return;
    is_writing_ = true;
    writing_ = std::move(next->bytes);
    ws_.binary(next->is_binary);
    ws_.async_write(boost::asio::buffer(writing_),
                    [self = this->shared_from_this()](boost::beast::error_code error, std::size_t) {
                      self->is_writing_ = false;
                      if (!error) self->pump();
                    });
  }

 private:
  void opened() {
    viewer_ = shared_.console.open(session_.name, session_.role);
    shared_.live.push_back(this->shared_from_this());
    pump();
    read();
  }

  // Reads until reading fails. The callbacks keep this object alive: when reading has failed and no
  // write is under way, it is destroyed.
  void read() {
    ws_.async_read(buffer_,
                   [self = this->shared_from_this()](boost::beast::error_code error, std::size_t) {
                     if (error || !self->has_patience() || !self->is_logged_in()) {
                       return self->end();
                     }
                     const std::string text = boost::beast::buffers_to_string(self->buffer_.data());
                     self->buffer_.consume(self->buffer_.size());
                     self->shared_.console.take(self->viewer_, text, clock_now());
                     self->pump();
                     self->read();
                   });
  }

  void end() {
    shared_.console.close(viewer_);
    viewer_ = 0;
    boost::beast::get_lowest_layer(ws_).close();
  }

  bool is_logged_in() const { return shared_.api.lasts(token_, clock_now()); }

  // Whether the browser sends at most kMostMessages_s messages a second; usually it sends a few.
  bool has_patience() {
    const double now_s = clock_monotonic_s();
    if (now_s > counted_from_s_ + 1.0) {
      counted_from_s_ = now_s;
      messages_ = 0;
    }
    return ++messages_ <= kMostMessages_s;
  }

  boost::beast::websocket::stream<Stream> ws_;
  Shared& shared_;
  Session session_;
  std::string token_;
  ConnectionLimit::Place place_;
  boost::beast::http::request<boost::beast::http::string_body> request_;
  boost::beast::flat_buffer buffer_;
  std::string writing_;
  bool is_writing_ = false;
  std::uint64_t viewer_ = 0;
  double counted_from_s_ = 0.0;
  int messages_ = 0;
};

}  // namespace ols::console
