#include "cue/inlet/poll_inlet.h"

#include <exception>
#include <utility>

#include "base/files/small_file.h"

namespace ols::cues {
namespace {

namespace beast = boost::beast;
namespace http = boost::beast::http;
using Error = boost::system::error_code;

constexpr std::size_t kLargest_bytes = 2'000'000;
constexpr auto kPatience = std::chrono::seconds(3);

}  // namespace

PollInlet::PollInlet(boost::asio::io_context& context, Source source, double poll_s, InletSink sink)
    : source_(std::move(source)),
      poll_(static_cast<std::int64_t>(1e3 * poll_s)),
      sink_(std::move(sink)),
      resolver_(context),
      stream_(context),
      timer_(context) {
  request_ = {http::verb::get, source_.path, 11};
  const bool is_v6 = source_.host.find(':') != std::string::npos;
  std::string host = is_v6 ? "[" + source_.host + "]" : source_.host;
  if (source_.port != 80) host += ":" + std::to_string(source_.port);
  request_.set(http::field::host, host);
  request_.set(http::field::connection, "close");
  look();
}

void PollInlet::look() { source_.carrier == Carrier::kFile ? read_file() : ask(); }

void PollInlet::look_again(std::chrono::milliseconds after) {
  timer_.expires_after(after);
  timer_.async_wait([this](const Error& ended) {
    if (!ended) look();
  });
}

// The same text again is no news; it only shows that its writer is alive.
void PollInlet::take(const std::string& text) {
  opened();
  if (text == last_) return;
  last_ = text;
  sink_.begins();
  received(sink_, text);
}

void PollInlet::fail(const std::string& why) {
  failed(why);
  look_again(poll_);
}

void PollInlet::read_file() {
  try {
    take(read_small_file(source_.path, kLargest_bytes));
  } catch (const std::exception& bad) {
    return fail(bad.what());
  }
  look_again(poll_);
}

// Each request has its own connection: servers of such files close connections as they like.
void PollInlet::ask() {
  Error no_address;
  const auto address = boost::asio::ip::make_address(source_.host, no_address);
  if (!no_address) {
    const boost::asio::ip::tcp::endpoint at(address, static_cast<std::uint16_t>(source_.port));
    return connect(boost::asio::ip::tcp::resolver::results_type::create(at, source_.host, ""));
  }
  resolver_.async_resolve(source_.host, std::to_string(source_.port),
                          [this](const Error& bad, const auto& found) {
                            if (bad) return fail(source_.host + ": " + bad.message());
                            connect(found);
                          });
}

void PollInlet::connect(const boost::asio::ip::tcp::resolver::results_type& found) {
  stream_.expires_after(kPatience);
  stream_.async_connect(found, [this](const Error& failure, const auto&) {
    if (failure) return fail(source_.host + ": " + failure.message());
    send();
  });
}

void PollInlet::send() {
  buffer_.clear();
  response_.emplace();
  response_->body_limit(kLargest_bytes);
  http::async_write(stream_, request_, [this](const Error& bad, std::size_t) {
    if (bad) return fail(source_.host + ": " + bad.message());
    http::async_read(stream_, buffer_, *response_, [this](const Error& failure, std::size_t) {
      stream_.close();
      if (failure) return fail(source_.host + ": " + failure.message());
      if (response_->get().result() != http::status::ok) {
        return fail(source_.host + ": answers " + std::to_string(response_->get().result_int()));
      }
      take(response_->get().body());
      look_again(poll_);
    });
  });
}

}  // namespace ols::cues
