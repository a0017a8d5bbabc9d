#include "console/video_link.h"

#include <array>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <utility>

#include "console/messages_pictures.h"

namespace ols::console {
namespace asio = boost::asio;
namespace {

constexpr double kRetry_s = 1.0;
// Long enough for a frame that the camera has not exposed yet. A peer that is gone costs a new
// connection each time.
constexpr double kPatience_s = 10.0;
constexpr std::uint32_t kLargestAnswer_bytes = 8U << 20U;

asio::steady_timer::duration duration(double seconds) {
  return std::chrono::duration_cast<asio::steady_timer::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

VideoLink::VideoLink(asio::io_context& io, const asio::ip::tcp::endpoint& endpoint,
                     const VideoWish& wish, Take take)
    : endpoint_(endpoint), wish_(wish), take_(std::move(take)), socket_(io), timer_(io) {}

void VideoLink::end() {
  has_ended_ = true;
  Error ignored;
  socket_.close(ignored);
  timer_.cancel();
}

template <class Next>
auto VideoLink::unless_it_fails(Next next) {
  return [self = shared_from_this(), next](const Error& error, std::size_t = 0) {
    if (self->has_ended_) return;
    if (error) return self->fail();
    next(*self);
  };
}

void VideoLink::connect() {
  expect_within(kPatience_s);
  socket_.async_connect(endpoint_, [connected = unless_it_fails([](VideoLink& link) {
                                      link.ask();
                                    })](const Error& error) { connected(error); });
}

void VideoLink::ask() {
  expect_within(kPatience_s);
  const bool wants_key = taken_ % kUnitsOfKeyFrame == 0;
  request_ = wish_.codec == Codec::kH264
                 ? stream_request(last_utime_us_, wish_.max_width_px, wish_.thin_quality, wants_key)
                 : video_request(last_utime_us_, wish_.max_width_px, wish_.quality);
  prefix_ = length_prefix(static_cast<std::uint32_t>(request_.size()));
  const std::array<asio::const_buffer, 2> parts{asio::buffer(prefix_), asio::buffer(request_)};
  asio::async_write(socket_, parts, unless_it_fails([](VideoLink& link) { link.receive(); }));
}

void VideoLink::receive() {
  asio::async_read(socket_, asio::buffer(prefix_), unless_it_fails([](VideoLink& link) {
                     const auto length = message_length(link.prefix_, kLargestAnswer_bytes);
                     if (!length) return link.fail();
                     link.receive_body(*length);
                   }));
}

void VideoLink::receive_body(std::uint32_t length) {
  answer_.resize(length);
  asio::async_read(socket_, asio::buffer(answer_),
                   unless_it_fails([](VideoLink& link) { link.taken(); }));
}

void VideoLink::taken() {
  const auto utime_us = take_(std::exchange(answer_, {}));
  if (!utime_us) return fail();
  last_utime_us_ = *utime_us;
  ++taken_;
  timer_.expires_after(duration(wish_.interval_s));
  timer_.async_wait([self = shared_from_this()](const Error& error) {
    if (!error && !self->has_ended_) self->ask();
  });
}

void VideoLink::fail() {
  if (has_ended_) return;
  Error ignored;
  socket_.close(ignored);
  last_utime_us_ = 0;  // it may have restarted with another clock
  taken_ = 0;
  timer_.expires_after(duration(kRetry_s));
  timer_.async_wait([self = shared_from_this()](const Error& error) {
    if (!error && !self->has_ended_) self->connect();
  });
}

void VideoLink::expect_within(double seconds) {
  timer_.expires_after(duration(seconds));
  timer_.async_wait([self = shared_from_this()](const Error& error) {
    Error ignored;
    // The operation under way then fails.
    if (!error && !self->has_ended_) self->socket_.close(ignored);
  });
}

}  // namespace ols::console
