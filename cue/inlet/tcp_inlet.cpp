#include "cue/inlet/tcp_inlet.h"

#include <boost/asio/buffer.hpp>
#include <boost/asio/connect.hpp>
#include <boost/asio/error.hpp>
#include <chrono>
#include <string>
#include <utility>

#include "base/net/tcp_keepalive.h"

namespace ols::cues {
namespace {

namespace asio = boost::asio;
using Error = boost::system::error_code;

constexpr auto kPatience = std::chrono::seconds(3);
constexpr std::size_t kPiece_bytes = 4096;  // parsed in a few milliseconds

}  // namespace

TcpInlet::TcpInlet(asio::io_context& context, Source source, InletSink sink)
    : source_(std::move(source)),
      sink_(std::move(sink)),
      resolver_(context),
      socket_(context),
      timer_(context),
      buffer_(kPiece_bytes) {
  open();
}

void TcpInlet::give_patience() {
  timer_.expires_after(kPatience);
  timer_.async_wait([this](const Error& ended) {
    if (ended) return;
    resolver_.cancel();
    Error ignored;
    static_cast<void>(socket_.close(ignored));
  });
}

// All look-ups share one thread, which a silent DNS server blocks. An IP address needs no look-up.
void TcpInlet::open() {
  Error no_address;
  const auto address = asio::ip::make_address(source_.host, no_address);
  if (!no_address) {
    const asio::ip::tcp::endpoint at(address, static_cast<std::uint16_t>(source_.port));
    return connect(asio::ip::tcp::resolver::results_type::create(at, source_.host, ""));
  }
  resolver_.async_resolve(source_.host, std::to_string(source_.port),
                          [this](const Error& bad, const auto& found) {
                            if (bad) return fail(bad.message());
                            connect(found);
                          });
}

void TcpInlet::connect(const asio::ip::tcp::resolver::results_type& found) {
  give_patience();
  asio::async_connect(socket_, found, [this](const Error& bad, const asio::ip::tcp::endpoint&) {
    if (bad) return fail(bad == asio::error::operation_aborted ? "no answer" : bad.message());
    connected();
  });
}

void TcpInlet::connected() {
  timer_.cancel();
  // A server that has vanished without a word is noticed within 5 s.
  keep_alive(socket_.native_handle(), {.idle_s = 2, .interval_s = 1, .probes = 3});
  back_off_.after_success();
  opened();
  sink_.begins();
  listen();
}

void TcpInlet::listen() {
  socket_.async_read_some(asio::buffer(buffer_), [this](const Error& bad, std::size_t bytes) {
    if (bad) return fail(bad == asio::error::eof ? "it has ended the connection" : bad.message());
    received(sink_, {buffer_.data(), bytes});
    listen();
  });
}

void TcpInlet::fail(const std::string& why) {
  Error ignored;
  static_cast<void>(socket_.close(ignored));
  failed(source_.host + ":" + std::to_string(source_.port) + ": " + why);
  timer_.expires_after(
      std::chrono::milliseconds(static_cast<std::int64_t>(1e3 * back_off_.after_failure())));
  timer_.async_wait([this](const Error& ended) {
    if (!ended) open();
  });
}

}  // namespace ols::cues
