// Limits the attempts to log in, per address and for all addresses together. A few attempts are
// allowed at once, then one more after each interval. Pure.
#pragma once

#include <cstddef>
#include <map>
#include <string>

namespace ols::console {

class LoginLimit {
 public:
  // Whether this address may try to log in now. Counts the attempt.
  bool admit(const std::string& address, double now_s);

  static constexpr double kTries = 5.0;        // attempts that are allowed at once
  static constexpr double kRegained_s = 10.0;  // one more attempt is allowed after this time
  static constexpr double kAllTries = 50.0;    // the same for all addresses together
  static constexpr double kAllRegained_s = 1.0;
  static constexpr std::size_t kMostAddresses = 1000;

 private:
  struct Bucket {
    double tries = 0.0, at_s = 0.0;
    bool take(double most, double regained_s, double now_s);
  };
  std::map<std::string, Bucket> addresses_;
  Bucket all_{kAllTries, 0.0};
};

}  // namespace ols::console
