// HTTP to a camera over TLS: a certificate is believed if its key is pinned, or an authority has
// signed it; the request goes to nobody else.
#include "edge/mount/onvif/http_link.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/ssl.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <thread>

#include "tests/unit/edge/device/made_certificate.h"
#include "tests/unit/error_text.h"

namespace ols::onvif {
namespace {

namespace net = boost::asio;
namespace http = boost::beast::http;
using net::ip::tcp;
using testing::HasSubstr;

// Answers each request with "hello".
class Server {
 public:
  explicit Server(const device::MadeCertificate& certificate) {
    const net::const_buffer pem = net::buffer(certificate.pem);
    context_.use_certificate(pem, net::ssl::context::pem);
    context_.use_private_key(pem, net::ssl::context::pem);
    thread_ = std::thread([this] { run(); });
  }
  ~Server() {
    ended_ = true;
    boost::system::error_code ignored;
    tcp::socket(io_).connect(acceptor_.local_endpoint(), ignored);
    thread_.join();
  }
  std::string url() const {
    return "https://127.0.0.1:" + std::to_string(acceptor_.local_endpoint().port()) + "/";
  }
  int requests() const { return requests_; }

 private:
  void run() {
    while (!ended_) {
      net::ssl::stream<tcp::socket> stream(acceptor_.accept(), context_);
      boost::system::error_code error;
      stream.handshake(net::ssl::stream_base::server, error);
      boost::beast::flat_buffer buffer;
      while (!error) {
        http::request<http::string_body> request;
        http::read(stream, buffer, request, error);
        if (error) break;
        ++requests_;
        http::response<http::string_body> response(http::status::ok, 11, "hello");
        response.prepare_payload();
        http::write(stream, response, error);
      }
    }
  }

  net::io_context io_;
  net::ssl::context context_{net::ssl::context::tls_server};
  tcp::acceptor acceptor_{io_, {net::ip::make_address("127.0.0.1"), 0}};
  std::atomic<bool> ended_ = false;
  std::atomic<int> requests_ = 0;
  std::thread thread_;
};

HttpLink::Answer post(const Server& server, const std::string& pin) {
  HttpLink link({5.0, pin});
  return link.post(server.url(), "a", "secret", nullptr);
}

TEST(HttpLink, AnOwnCertificateIsRefusedWithItsKeyAndTakenOnceThatIsPinned) {
  const auto certificate = device::made_certificate("camera");
  const Server server(certificate);
  const std::string why = error_text<CertificateRefused>([&] { post(server, ""); });
  EXPECT_THAT(why, HasSubstr("self-signed"));
  EXPECT_THAT(why, HasSubstr("its key is " + certificate.pin));
  EXPECT_EQ(server.requests(), 0);
  EXPECT_EQ(post(server, certificate.pin).body, "hello");
}

TEST(HttpLink, AnotherKeyThanThePinnedIsRefused) {
  const auto certificate = device::made_certificate("camera");
  const Server server(certificate);
  const std::string why =
      error_text<CertificateRefused>([&] { post(server, device::made_certificate("camera").pin); });
  EXPECT_THAT(why, HasSubstr("not pinned_key; its key is " + certificate.pin));
  EXPECT_EQ(server.requests(), 0);
}

// The clock of a camera, or of the station before it has the time, must not lock it out.
TEST(HttpLink, APinnedKeyIsEnoughWhenTheCertificateHasExpired) {
  const auto certificate = device::made_certificate("camera", -1);
  const Server server(certificate);
  EXPECT_THROW(post(server, ""), CertificateRefused);
  EXPECT_EQ(post(server, certificate.pin).body, "hello");
}

}  // namespace
}  // namespace ols::onvif
