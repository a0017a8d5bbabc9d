#include "edge/video/video_session.h"

#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <utility>

namespace ols::video {
namespace asio = boost::asio;
using Error = boost::system::error_code;
namespace {

constexpr double kIdle_s = 30.0;    // without a request
constexpr double kStalled_s = 5.0;  // for one picture

}  // namespace

VideoSession::VideoSession(asio::ip::tcp::socket socket, Callbacks callbacks)
    : socket_(std::move(socket)),
      timer_(socket_.get_executor()),
      callbacks_(std::move(callbacks)) {}

void VideoSession::read_request() {
  expect_within(kIdle_s, End::kIdle);
  asio::async_read(socket_, asio::buffer(prefix_),
                   [self = shared_from_this()](const Error& error, std::size_t) {
                     if (error) return self->close(End::kGone);
                     const auto length = message_length(self->prefix_, kLargestRequest_bytes);
                     if (!length) return self->close(End::kMalformed);
                     self->read_body(*length);
                   });
}

void VideoSession::read_body(std::uint32_t length) {
  asio::async_read(socket_, asio::buffer(body_, length),
                   [self = shared_from_this()](const Error& error, std::size_t read) {
                     if (error) return self->close(End::kGone);
                     self->take(std::span(self->body_).first(read));
                   });
}

void VideoSession::take(std::span<const std::uint8_t> body) {
  request_ = decode_request(body);
  if (!request_) return close(End::kMalformed);
  // Until there is a frame; a camera that is gone must not end its viewers.
  timer_.cancel();
  // A viewer that leaves meanwhile becomes readable; so does one that does not wait for its answer.
  socket_.async_wait(asio::ip::tcp::socket::wait_read,
                     [self = shared_from_this()](const Error& error) {
                       Error gone;
                       if (error || !self->request_) return;
                       const bool left = self->socket_.available(gone) == 0 || gone;
                       self->close(left ? End::kGone : End::kMalformed);
                     });
  callbacks_.asked(*this);
}

void VideoSession::answer(const Bytes& message) {
  request_.reset();
  Error ignored;
  socket_.cancel(ignored);  // no longer waits for it to leave
  sent_ = message;
  expect_within(kStalled_s, End::kStalled);
  prefix_ = length_prefix(static_cast<std::uint32_t>(message->size()));
  const std::array<asio::const_buffer, 2> parts{asio::buffer(prefix_), asio::buffer(*message)};
  asio::async_write(socket_, parts, [self = shared_from_this()](const Error& error, std::size_t) {
    if (error) return self->close(End::kGone);
    self->sent_.reset();
    self->read_request();
  });
}

void VideoSession::close(End end) {
  if (std::exchange(ended_, true)) return;
  timer_.cancel();
  Error ignored;
  socket_.close(ignored);
  callbacks_.ended(*this, end);
}

void VideoSession::expect_within(double seconds, End otherwise) {
  timer_.expires_after(std::chrono::duration_cast<asio::steady_timer::duration>(
      std::chrono::duration<double>(seconds)));
  timer_.async_wait([self = shared_from_this(), otherwise](const Error& error) {
    if (!error) self->close(otherwise);
  });
}

}  // namespace ols::video
