#include "geometry/chi_square.h"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/non_central_chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace ols {

using boost::math::chi_squared;
using boost::math::complement;
using boost::math::non_central_chi_squared;

double chi_square_critical(double level, int degrees) {
  if (!(level > 0.0 && level < 1.0) || degrees < 1) {
    throw std::invalid_argument("chi-square: level or degrees of freedom out of range");
  }
  return quantile(complement(chi_squared(degrees), level));
}

double normal_level(double sigma) { return 0.5 * std::erfc(sigma / std::numbers::sqrt2); }

double chi_square_power(double limit, int degrees, double noncentrality) {
  return cdf(complement(non_central_chi_squared(degrees, noncentrality), limit));
}

double least_noncentrality(double limit, int degrees, double power) {
  if (chi_square_power(limit, degrees, 0.0) >= power) return 0.0;
  return non_central_chi_squared::find_non_centrality(
      complement(static_cast<double>(degrees), limit, power));
}

}  // namespace ols
