#include "geometry/chi_square.h"

#include <cmath>
#include <stdexcept>
#include <unsupported/Eigen/SpecialFunctions>

namespace ols {
namespace {

double exceeds(double limit, double degrees) {
  return Eigen::numext::igammac(0.5 * degrees, 0.5 * limit);
}

// Where the monotonic `f` is zero, above 0.
template <class F>
double root(F f) {
  constexpr double kClose = 1e-13;
  const bool falls = f(0.0) > 0.0;
  double low = 0.0, high = 1.0;
  while ((f(high) > 0.0) == falls) high *= 2.0;
  while (high - low > kClose * high) {
    const double middle = 0.5 * (low + high);
    ((f(middle) > 0.0) == falls ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

double chi_square_critical(double level, int degrees) {
  if (!(level > 0.0 && level < 1.0) || degrees < 1) {
    throw std::invalid_argument("chi-square: no such level or degrees of freedom");
  }
  return root([&](double limit) { return exceeds(limit, degrees) - level; });
}

// A Poisson mixture of central ones (Johnson, Kotz & Balakrishnan, Continuous Univariate
// Distributions 2, 29.2), summed to both sides of its largest weight.
double chi_square_power(double limit, int degrees, double noncentrality) {
  constexpr double kNegligible = 1e-15;
  const double mean = 0.5 * noncentrality;
  if (!(mean > 0.0)) return exceeds(limit, degrees);
  const double middle = std::floor(mean);
  const double most = std::exp(middle * std::log(mean) - mean - std::lgamma(middle + 1.0));
  double sum = 0.0, weight = most;
  for (double j = middle; j >= 0.0 && weight > kNegligible; --j) {
    sum += weight * exceeds(limit, degrees + 2.0 * j);
    weight *= j / mean;
  }
  weight = most * mean / (middle + 1.0);
  for (double j = middle + 1.0; weight > kNegligible; ++j) {
    sum += weight * exceeds(limit, degrees + 2.0 * j);
    weight *= mean / (j + 1.0);
  }
  return sum;
}

double least_noncentrality(double limit, int degrees, double power) {
  if (chi_square_power(limit, degrees, 0.0) >= power) return 0.0;
  return root([&](double l) { return chi_square_power(limit, degrees, l) - power; });
}

}  // namespace ols
