// The chi-square distribution, for tests of hypotheses: Boost.Math's.
#pragma once

namespace ols {

// What a sum of squares of `degrees` standard normal variables exceeds with the probability `level`
// (0 < level < 1). std::invalid_argument otherwise.
double chi_square_critical(double level, int degrees);

// The probability that one such variable exceeds `sigma`: a level, told as a number of sigmas.
double normal_level(double sigma);

// The probability that the sum exceeds `limit` when their means' squares sum up to `noncentrality`.
double chi_square_power(double limit, int degrees, double noncentrality);

// The noncentrality at which the sum exceeds `limit` with the probability `power` (Baarda's
// lambda_0); 0 where it does so anyway.
double least_noncentrality(double limit, int degrees, double power);

}  // namespace ols
