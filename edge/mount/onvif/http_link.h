// One HTTP exchange at a time with a camera, over a connection that is kept (libcurl). Redirections
// and proxies are not followed, because the password belongs to the configured host alone.
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
// interrupt() ended the exchange.
struct Interrupted : HttpError {
  Interrupted() : HttpError("interrupted") {}
};

class HttpLink {
 public:
  static constexpr std::size_t kLongestAnswer = 256 * 1024;
  struct Config {
    double timeout_s = 2.0;  // of a whole exchange
    std::string pinned_key;  // "sha256//...": of the camera's certificate; empty: authorities vouch
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

  // `digest`: logs in by HTTP digest; null: does not log in. Throws HttpError.
  Answer post(const std::string& url, const std::string& action, const std::string& text,
              const Credentials* digest);

  // From any thread: ends the exchange under way, and refuses others until resume().
  void interrupt();
  void resume();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::onvif
