#include "sim/telescope/telescope_server.h"

#include <algorithm>
#include <array>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <chrono>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <thread>
#include <vector>

#include "base/process/clocks.h"

namespace ols::sim {
namespace {

namespace net = boost::asio;
using tcp = net::ip::tcp;
using Error = boost::system::error_code;

constexpr std::size_t kMostBytes = 65536;  // of an element

double utc_s() { return 1e-9 * static_cast<double>(clock_utc_ns()); }

// The first whole element of a stream, which it loses; nullopt: it has none yet.
std::optional<std::string> next_element(std::string& stream) {
  const std::size_t start = stream.find('<');
  if (start == std::string::npos) return std::nullopt;
  const std::size_t name_end = stream.find_first_of(" \t\r\n/>", start + 1);
  const std::size_t open_end = stream.find('>', start);
  if (name_end == std::string::npos || open_end == std::string::npos) return std::nullopt;
  std::size_t end = open_end;
  if (stream[open_end - 1] != '/') {
    const std::string close = "</" + stream.substr(start + 1, name_end - start - 1) + ">";
    const std::size_t at = stream.find(close, open_end);
    if (at == std::string::npos) return std::nullopt;
    end = at + close.size() - 1;
  }
  std::string element = stream.substr(start, end + 1 - start);
  stream.erase(0, end + 1);
  return element;
}

}  // namespace

struct TelescopeServer::Impl {
  Impl(const TelescopeConfig& config, std::uint64_t seed);
  ~Impl() {
    io.stop();
    thread.join();
  }
  void accept();
  void report();
  void tell_all(const std::string& text);

  class Client;
  net::io_context io{1};
  tcp::acceptor acceptor;
  net::steady_timer timer{io};
  std::vector<std::weak_ptr<Client>> clients;
  std::mutex mutex;  // of the telescope
  Telescope telescope;
  std::thread thread;  // last: it uses the rest
};

class TelescopeServer::Impl::Client : public std::enable_shared_from_this<Client> {
 public:
  Client(tcp::socket socket, Impl& server) : socket_(std::move(socket)), server_(server) {}

  void read() {
    socket_.async_read_some(net::buffer(bytes_),
                            [self = shared_from_this()](Error error, std::size_t count) {
                              if (!error) self->take({self->bytes_.data(), count});
                            });
  }
  void tell(const std::string& text) {
    if (text.empty()) return;
    waiting_ += text;
    if (sending_.empty()) send();
  }

 private:
  void take(std::string_view bytes) {
    received_ += bytes;
    while (const auto element = next_element(received_)) {
      std::string answer;
      {
        const std::lock_guard lock(server_.mutex);
        answer = server_.telescope.answer(*element, clock_monotonic_s(), utc_s());
      }
      server_.tell_all(answer);
    }
    if (received_.size() < kMostBytes) read();
  }
  void send() {
    sending_.swap(waiting_);
    if (sending_.empty()) return;
    net::async_write(socket_, net::buffer(sending_),
                     [self = shared_from_this()](Error error, std::size_t) {
                       self->sending_.clear();
                       if (!error) self->send();
                     });
  }

  tcp::socket socket_;
  Impl& server_;
  std::array<char, 4096> bytes_{};
  std::string received_, waiting_, sending_;
};

TelescopeServer::Impl::Impl(const TelescopeConfig& config, std::uint64_t seed)
    : acceptor(io,
               {net::ip::make_address(config.address), static_cast<std::uint16_t>(config.port)}),
      telescope(config, seed, clock_monotonic_s()) {
  accept();
  report();
  thread = std::thread([this] { io.run(); });
}

void TelescopeServer::Impl::accept() {
  acceptor.async_accept([this](Error error, tcp::socket socket) {
    if (!error) {
      auto client = std::make_shared<Client>(std::move(socket), *this);
      clients.push_back(client);
      client->read();
    }
    accept();
  });
}

void TelescopeServer::Impl::tell_all(const std::string& text) {
  std::erase_if(clients, [](const auto& client) { return client.expired(); });
  for (const auto& client : clients)
    if (const auto here = client.lock()) here->tell(text);
}

void TelescopeServer::Impl::report() {
  std::string text;
  double interval_s = 0.0;
  {
    const std::lock_guard lock(mutex);
    text = telescope.report(clock_monotonic_s(), utc_s());
    interval_s = telescope.interval_s();
  }
  tell_all(text);
  timer.expires_after(std::chrono::microseconds(std::llround(1e6 * interval_s)));
  timer.async_wait([this](Error error) {
    if (!error) report();
  });
}

TelescopeServer::TelescopeServer(const TelescopeConfig& config, std::uint64_t seed) try
    : impl_(std::make_unique<Impl>(config, seed)) {
} catch (const boost::system::system_error& problem) {
  throw std::runtime_error("no INDI server at " + config.address + ": " + problem.what());
}

TelescopeServer::~TelescopeServer() = default;

int TelescopeServer::port() const { return impl_->acceptor.local_endpoint().port(); }

void TelescopeServer::set_faults(const PtuFaults& faults) {
  const std::lock_guard lock(impl_->mutex);
  impl_->telescope.set_faults(faults.ptz, clock_monotonic_s());
}

PanTilt TelescopeServer::angles_at(double monotonic_s) {
  const std::lock_guard lock(impl_->mutex);
  return impl_->telescope.angles_at(monotonic_s);
}

}  // namespace ols::sim
