// Values that take long to make and are needed for several worlds of one process.
#pragma once

#include <functional>
#include <map>

namespace ols::sim {

template <typename Key, typename Value>
class Remembered {
 public:
  // `make` must depend on nothing but the key.
  Value of(const Key& key, const std::function<Value()>& make) {
    const auto found = values_.find(key);
    if (found != values_.end()) return found->second;
    if (values_.size() == kMost) values_.clear();
    return values_.emplace(key, make()).first->second;
  }

 private:
  static constexpr std::size_t kMost = 12;  // more than the stations of a site
  std::map<Key, Value> values_;
};

}  // namespace ols::sim
