// One HTTP exchange at a time with a camera, over a connection that is kept (libcurl). Redirections
// and proxies are not followed, because the password is meant only for the configured host.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "edge/mount/onvif/soap_request.h"

namespace ols::onvif {

struct HttpError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Thrown when interrupt() has ended the exchange.
struct Interrupted : HttpError {
  Interrupted() : HttpError("interrupted") {}
};

class HttpLink {
 public:
  static constexpr std::size_t kLongestAnswer = 256 * 1024;
  struct Config {
    double timeout_s = 2.0;  // for a whole exchange
    std::string pinned_key;  // "sha256//..." of the camera's certificate; empty: trusts authorities
  };
  struct Answer {
    long status = 0;
    std::string body;
    bool offers_digest = false;
  };

  explicit HttpLink(const Config& config);
  ~HttpLink();
  HttpLink(const HttpLink&) = delete;
  HttpLink& operator=(const HttpLink&) = delete;

  // `digest`: the login for HTTP digest; null for no login. Throws HttpError.
  Answer post(const std::string& url, const std::string& action, const std::string& text,
              const Credentials* digest);

  // May be called from any thread. Ends the current exchange, and refuses others until resume().
  void interrupt();
  void resume();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::onvif
