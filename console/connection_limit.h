// How many connections there may be, of all and of one address: no host can use up what all share.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace ols::console {

class ConnectionLimit {
 public:
  // To be kept for as long as the connection lasts; null: there is no room for it.
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
