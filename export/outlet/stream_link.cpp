#include "export/outlet/stream_link.h"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/ip/address.hpp>
#include <cerrno>
#include <cstring>
#include <utility>

#include "base/process/clocks.h"

namespace ols::exports {
namespace {

std::string last_openssl_error() {
  const unsigned long code = ERR_get_error();
  ERR_clear_error();
  const char* const reason = code == 0 ? nullptr : ERR_reason_error_string(code);
  return reason == nullptr ? "the connection broke" : reason;
}

bool is_ip(const std::string& host) {
  boost::system::error_code bad;
  static_cast<void>(boost::asio::ip::make_address(host, bad));
  return !bad;
}

}  // namespace

struct StreamLink::Tls {
  struct Free {
    void operator()(SSL_CTX* context) const { SSL_CTX_free(context); }
    void operator()(SSL* session) const { SSL_free(session); }
  };
  std::unique_ptr<SSL_CTX, Free> context;
  std::unique_ptr<SSL, Free> session;

  Tls(const TlsFiles& files, const std::string& host, int fd)
      : context(SSL_CTX_new(TLS_client_method())) {
    SSL_CTX_set_min_proto_version(context.get(), TLS1_2_VERSION);
    SSL_CTX_set_verify(context.get(), SSL_VERIFY_PEER, nullptr);
    // A receiver that asks for renegotiation and then says nothing would keep the writer busy for
    // ever.
    SSL_CTX_set_options(context.get(), SSL_OP_NO_RENEGOTIATION);
    SSL_CTX_set_mode(context.get(),
                     SSL_MODE_ENABLE_PARTIAL_WRITE | SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
    load(files);
    session.reset(SSL_new(context.get()));
    if (is_ip(host)) {
      expect(X509_VERIFY_PARAM_set1_ip_asc(SSL_get0_param(session.get()), host.c_str()), host);
    } else {
      expect(SSL_set1_host(session.get(), host.c_str()), host);
      // The library's macro for this has a cast in C's style.
      SSL_ctrl(session.get(), SSL_CTRL_SET_TLSEXT_HOSTNAME, TLSEXT_NAMETYPE_host_name,
               const_cast<char*>(host.c_str()));
    }
    SSL_set_fd(session.get(), fd);
  }

  // Without a check of the name, the certificate of any receiver would do.
  static void expect(int result, const std::string& host) {
    if (result != 1) throw LinkError(host + ": its certificate cannot be checked");
  }

  void load(const TlsFiles& files) {
    const bool has_authority =
        files.ca.empty()
            ? SSL_CTX_set_default_verify_paths(context.get()) == 1
            : SSL_CTX_load_verify_locations(context.get(), files.ca.c_str(), nullptr) == 1;
    if (!has_authority) throw LinkError(files.ca + ": " + last_openssl_error());
    if (files.certificate.empty()) return;
    if (SSL_CTX_use_certificate_chain_file(context.get(), files.certificate.c_str()) != 1) {
      throw LinkError(files.certificate + ": " + last_openssl_error());
    }
    if (SSL_CTX_use_PrivateKey_file(context.get(), files.key.c_str(), SSL_FILETYPE_PEM) != 1) {
      throw LinkError(files.key + ": " + last_openssl_error());
    }
  }

  // What to wait for before the same call again: POLLIN or POLLOUT; 0: it has failed.
  short wants(int result) const {
    switch (SSL_get_error(session.get(), result)) {
      case SSL_ERROR_WANT_READ:
        return POLLIN;
      case SSL_ERROR_WANT_WRITE:
        return POLLOUT;
      default:
        return 0;
    }
  }
  // Why the receiver's certificate is refused; empty: it is not.
  std::string certificate_trouble() const {
    const long verdict = SSL_get_verify_result(session.get());
    if (verdict == X509_V_OK) return {};
    return std::string("its certificate is refused: ") + X509_verify_cert_error_string(verdict);
  }
};

StreamLink::StreamLink(const Address& address, TlsFiles files)
    : address_(address), files_(std::move(files)) {}

StreamLink::~StreamLink() { close(); }

LinkError StreamLink::error(const std::string& what) const {
  return LinkError(address_.host + ":" + std::to_string(address_.port) + ": " + what);
}

void StreamLink::open() {
  close();
  socket_.emplace(address_.host, address_.port, kPatience_s);
  if (address_.scheme != Scheme::kTls) return;
  ERR_clear_error();
  tls_ = std::make_unique<Tls>(files_, address_.host, socket_->descriptor());
  shake_hands();
}

void StreamLink::shake_hands() {
  const double end_s = clock_monotonic_s() + kPatience_s;
  while (true) {
    const int result = SSL_connect(tls_->session.get());
    if (result == 1) return;
    const short wanted = tls_->wants(result);
    if (wanted == 0) {
      const std::string trouble = tls_->certificate_trouble();
      throw error(trouble.empty() ? "TLS: " + last_openssl_error() : trouble);
    }
    if (!wait_until(end_s, wanted == POLLOUT)) throw error("does not answer with TLS");
  }
}

bool StreamLink::wait_until(double end_s, bool to_write) const {
  const double left_s = end_s - clock_monotonic_s();
  return left_s > 0.0 && socket_->wait(to_write, left_s);
}

// How many bytes; 0: the receiver has no room; negative: it is gone.
long StreamLink::write_some(const std::string& bytes, std::size_t from) {
  const std::size_t left = bytes.size() - from;
  if (tls_) {
    const int result = SSL_write(tls_->session.get(), bytes.data() + from, static_cast<int>(left));
    if (result > 0) return result;
    return tls_->wants(result) != 0 ? 0 : -1;
  }
  const ssize_t result =
      ::send(socket_->descriptor(), bytes.data() + from, left, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (result >= 0) return result;
  return errno == EAGAIN || errno == EINTR ? 0 : -1;
}

void StreamLink::send(const Packet& packet) {
  const double end_s = clock_monotonic_s() + kPatience_s;
  std::size_t written = 0;
  while (written < packet.bytes.size()) {
    const long count = write_some(packet.bytes, written);
    if (count < 0) throw error("has closed the connection");
    written += static_cast<std::size_t>(count);
    if (count == 0 && !wait_until(end_s, true)) throw error("does not read");
  }
}

// Reads all that is decoded already, because the socket no longer reports it.
void StreamLink::drain_tls() {
  std::array<char, 4096> bytes{};
  do {
    const int count = SSL_read(tls_->session.get(), bytes.data(), bytes.size());
    if (count > 0) {
      heard({bytes.data(), static_cast<std::size_t>(count)});
    } else if (tls_->wants(count) == 0) {
      const std::string trouble = tls_->certificate_trouble();
      throw error(trouble.empty() ? "has closed the connection: " + last_openssl_error() : trouble);
    } else {
      return;
    }
  } while (SSL_pending(tls_->session.get()) > 0);
}

void StreamLink::drain() {
  if (tls_) return drain_tls();
  std::array<char, 4096> bytes{};
  const ssize_t count = ::recv(socket_->descriptor(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  if (count > 0) heard({bytes.data(), static_cast<std::size_t>(count)});
  if (count == 0) throw error("has closed the connection");
  if (count < 0 && errno != EAGAIN && errno != EINTR) throw error(std::strerror(errno));
}

void StreamLink::wait(int wake_fd, double seconds) {
  std::array<pollfd, 2> ready{{{socket_->descriptor(), POLLIN, 0}, {wake_fd, POLLIN, 0}}};
  ::poll(ready.data(), ready.size(), static_cast<int>(1e3 * seconds));
  if (ready[0].revents != 0) drain();
}

void StreamLink::close() {
  tls_.reset();
  socket_.reset();
}

}  // namespace ols::exports
