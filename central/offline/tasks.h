// Independent parts of a computation. A caller with threads runs them concurrently; by default they
// run one after the other.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace ols::fusion {

using Tasks = std::vector<std::function<void()>>;

struct Workers {
  std::size_t count = 1;  // number of parts
  std::function<void(const Tasks&)> run = [](const Tasks& tasks) {
    for (const auto& task : tasks) task();
  };
};

}  // namespace ols::fusion
