// Random numbers that are the same with every standard library. (The standard specifies the engine,
// but not the results of its distributions.)
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace ols::tracker {

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  // Uniform in [0, 1).
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  // Standard normal, by the Box-Muller method.
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace ols::tracker
