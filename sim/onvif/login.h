// Who may command a simulated ONVIF device: WS-UsernameToken with a digest (Web Services Security
// UsernameToken Profile 1.0) and HTTP digest (RFC 7616, MD5). Nonces are good once. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <random>
#include <set>
#include <string>
#include <string_view>

namespace ols::sim {

struct UsernameToken {
  std::string user, digest, nonce, created;  // digest and nonce in base64
};

// A dateTime of XML Schema in UTC [s since 1970]; NaN: not one.
double utc_of(const std::string& date_time);
// The other way, with milliseconds.
std::string date_time_of(std::int64_t utime_us);

class Login {
 public:
  Login(std::string user, std::string password, std::uint64_t seed);

  // `utc_s`: the device's clock.
  bool accepts(const UsernameToken& token, double utc_s);

  // `authorization`, `method`, `target`: of the HTTP request. `now_s`: any clock.
  enum class Verdict { kGood, kWrong, kStale };
  Verdict accepts(std::string_view authorization, const std::string& method,
                  const std::string& target, double now_s);
  // The header WWW-Authenticate, with a new nonce.
  std::string challenge(bool is_stale, double now_s);

  static constexpr double kTokenAge_s = 5.0;    // most difference of a token's time to the clock
  static constexpr double kNonceAge_s = 120.0;  // how long a nonce of HTTP digest is good

 private:
  struct Issued {
    double at_s = 0.0;
    std::uint64_t count = 0;  // the newest one seen
  };

  const std::string user_, password_;
  std::mt19937_64 random_;
  std::map<std::string, Issued> issued_;
  std::deque<std::string> seen_;  // nonces of tokens
};

}  // namespace ols::sim
