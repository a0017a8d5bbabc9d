// Normally distributed random numbers by the million. Pure.
#pragma once

#include <cmath>
#include <random>

namespace ols::sim {

// The same numbers as libstdc++'s std::normal_distribution, which takes two logarithms of `long
// double` more for each uniform number if clang compiles it.
template <typename Real>
class Normal {
 public:
  Real operator()(std::mt19937_64& generator) {
    if (has_next_) {
      has_next_ = false;
      return next_;
    }
    Real x = 0, y = 0, square = 0;
    do {
      x = Real{2} * uniform(generator) - Real{1};
      y = Real{2} * uniform(generator) - Real{1};
      square = x * x + y * y;
    } while (square > Real{1} || square == Real{0});
    const Real scale = std::sqrt(-2 * std::log(square) / square);
    next_ = x * scale;
    has_next_ = true;
    return y * scale;
  }

 private:
  static Real uniform(std::mt19937_64& generator) {
    const Real value = static_cast<Real>(generator()) * Real{0x1p-64};
    return value < Real{1} ? value : std::nextafter(Real{1}, Real{0});
  }

  Real next_ = 0;
  bool has_next_ = false;
};

}  // namespace ols::sim
