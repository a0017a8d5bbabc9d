// Limits the number of connections, in total and per address, so that no host can take all of them.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace ols::console {

class ConnectionLimit {
 public:
  // A connection's place in the count. Keep it as long as the connection lasts; null: the
  // connection is refused.
  using Place = std::shared_ptr<const void>;
  Place admit(const std::string& address);

  static constexpr std::size_t kMost = 256, kMostOfOne = 32;

 private:
  struct Taken {
    std::size_t all = 0;
    std::map<std::string, std::size_t> of;
  };
  std::shared_ptr<Taken> taken_ = std::make_shared<Taken>();  // places outlive this object
};

}  // namespace ols::console
