// Checks the logins of clients of a simulated ONVIF device: WS-UsernameToken with a digest (Web
// Services Security UsernameToken Profile 1.0) or HTTP digest (RFC 7616, MD5). A token's nonce is
// accepted once. A nonce of HTTP digest is accepted for kNonceAge_s, with a count that must rise
// from request to request. Pure.
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

// Converts a dateTime of XML Schema in UTC to seconds since 1970; NaN: the text is not a dateTime.
double utc_of(const std::string& date_time);
// Converts UTC to a dateTime of XML Schema, with milliseconds.
std::string date_time_of(std::int64_t utime_us);

class Login {
 public:
  Login(std::string user, std::string password, std::uint64_t seed);

  // `utc_s`: the device's clock.
  bool accepts(const UsernameToken& token, double utc_s);

  // `authorization`, `method`, `target`: of the HTTP request. `now_s`: the time by a clock that
  // never decreases.
  enum class Verdict { kGood, kWrong, kStale };
  Verdict accepts(std::string_view authorization, const std::string& method,
                  const std::string& target, double now_s);
  // The header WWW-Authenticate, with a new nonce.
  std::string challenge(bool is_stale, double now_s);

  static constexpr double kTokenAge_s = 5.0;  // max difference between a token's time and the clock
  static constexpr double kNonceAge_s = 120.0;  // how long a nonce of HTTP digest is valid

 private:
  struct Issued {
    double at_s = 0.0;
    std::uint64_t count = 0;  // the largest count received with this nonce
  };

  const std::string user_, password_;
  std::mt19937_64 random_;
  std::map<std::string, Issued> issued_;
  std::deque<std::string> seen_;  // nonces of accepted tokens
};

}  // namespace ols::sim
