#include "sim/onvif/server.h"

#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <thread>

#include "base/process/clocks.h"
#include "sim/onvif/device.h"
#include "sim/onvif/probe_server.h"

namespace ols::sim {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace net = boost::asio;
using tcp = net::ip::tcp;

constexpr std::size_t kMostBodyBytes = 65536;
constexpr auto kPatience = std::chrono::seconds(30);

}  // namespace

struct OnvifServer::Impl {
  Impl(const OnvifConfig& wanted, std::uint64_t seed);
  ~Impl();
  void accept();

  net::io_context io{1};
  tcp::acceptor acceptor;
  std::mutex mutex;  // of the device
  const OnvifConfig config;
  OnvifDevice device;
  ProbeServer probes;
  std::thread thread;  // last: it uses the rest

 private:
  class Connection;
  static OnvifConfig bound(OnvifConfig config, const tcp::acceptor& acceptor);
};

class OnvifServer::Impl::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(tcp::socket socket, Impl& server) : stream_(std::move(socket)), server_(server) {}

  void read() {
    parser_.emplace();
    parser_->body_limit(kMostBodyBytes);
    stream_.expires_after(kPatience);
    http::async_read(stream_, buffer_, *parser_,
                     [self = shared_from_this()](beast::error_code error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  void answer() {
    const auto& request = parser_->get();
    std::optional<OnvifAnswer> answer;
    {
      const std::lock_guard lock(server_.mutex);
      answer = server_.device.answer(
          {std::string(request.method_string()), std::string(request.target()),
           std::string(request[http::field::authorization]), request.body()},
          clock_monotonic_s(), clock_utime_us());
    }
    if (!answer) return;  // the connection ends with its last owner
    response_ = {static_cast<http::status>(answer->status), 11};
    response_.set(http::field::content_type, "application/soap+xml; charset=utf-8");
    if (!answer->challenge.empty()) response_.set(http::field::www_authenticate, answer->challenge);
    response_.keep_alive(request.keep_alive());
    response_.body() = std::move(answer->body);
    response_.prepare_payload();
    http::async_write(stream_, response_,
                      [self = shared_from_this()](beast::error_code error, std::size_t) {
                        if (!error && self->response_.keep_alive()) self->read();
                      });
  }

  beast::tcp_stream stream_;
  Impl& server_;
  beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::string_body>> parser_;
  http::response<http::string_body> response_;
};

OnvifConfig OnvifServer::Impl::bound(OnvifConfig config, const tcp::acceptor& acceptor) {
  config.port = acceptor.local_endpoint().port();
  return config;
}

OnvifServer::Impl::Impl(const OnvifConfig& wanted, std::uint64_t seed)
    : acceptor(io,
               {net::ip::make_address(wanted.address), static_cast<std::uint16_t>(wanted.port)}),
      config(bound(wanted, acceptor)),
      device(config, seed, clock_monotonic_s()),
      probes(io, config) {
  accept();
  thread = std::thread([this] { io.run(); });
}

OnvifServer::Impl::~Impl() {
  io.stop();
  thread.join();
}

void OnvifServer::Impl::accept() {
  acceptor.async_accept([this](beast::error_code error, tcp::socket socket) {
    if (!error) std::make_shared<Connection>(std::move(socket), *this)->read();
    accept();
  });
}

OnvifServer::OnvifServer(const OnvifConfig& config, std::uint64_t seed) try
    : impl_(std::make_unique<Impl>(config, seed)) {
} catch (const boost::system::system_error& problem) {
  throw std::runtime_error("no ONVIF device at " + config.address + ": " + problem.what());
}

OnvifServer::~OnvifServer() = default;

int OnvifServer::port() const { return impl_->acceptor.local_endpoint().port(); }

void OnvifServer::set_faults(const PtuFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->device.set_faults(faults.ptz, clock_monotonic_s());
}

PanTilt OnvifServer::angles_at(double monotonic_s) {
  const std::lock_guard lock(impl_->mutex);
  return impl_->device.angles_at(monotonic_s);
}

}  // namespace ols::sim
