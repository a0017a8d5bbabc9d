// HTTP exchanges with a camera, one at a time, over a persistent connection (libcurl). Redirections
// are not followed and proxies are not used, because the password may go only to the configured
// host.
#pragma once

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "edge/mount/onvif/soap_request.h"

namespace ols::onvif {

struct HttpError : std::runtime_error {
  using std::runtime_error::runtime_error;
};
// Nobody whom this system trusts has signed the camera's certificate, or the certificate is for
// another host or time, or its key is not the pinned one. `key`: of the camera that answers, as
// certificate_key() (edge/device/certificate_key.h); empty if it could not be read.
struct CertificateRefused : HttpError {
  CertificateRefused(const std::string& words, std::string of_camera)
      : HttpError(words), key(std::move(of_camera)) {}
  std::string key;
};
// Thrown by post() if interrupt() has ended the exchange.
struct Interrupted : HttpError {
  Interrupted() : HttpError("interrupted") {}
};

class HttpLink {
 public:
  static constexpr std::size_t kLongestAnswer = 256 * 1024;
  struct Config {
    double timeout_s = 2.0;  // for a whole exchange
    // "sha256//...": hash of the public key in the camera's certificate; if empty, the certificate
    // must be signed by a known authority
    std::string pinned_key;
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

  // Sends `text` and waits for the answer. `action`: the SOAP action. `digest`: the login by HTTP
  // digest; null for none. Throws HttpError.
  Answer post(const std::string& url, const std::string& action, const std::string& text,
              const Credentials* digest);

  // Ends the current exchange, and refuses others until resume(). May be called from any thread.
  void interrupt();
  void resume();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ols::onvif
