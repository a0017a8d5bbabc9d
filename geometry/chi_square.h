// The chi-square distribution, for tests of hypotheses. The incomplete gamma function is Eigen's.
#pragma once

namespace ols {

// What a sum of squares of `degrees` standard normal variables exceeds with the probability `level`
// (0 < level < 1). std::invalid_argument otherwise.
double chi_square_critical(double level, int degrees);

// The probability that it exceeds `limit` when the means' squares sum up to `noncentrality`.
double chi_square_power(double limit, int degrees, double noncentrality);

// The noncentrality at which it exceeds `limit` with the probability `power` (Baarda's lambda_0);
// 0 where it does so anyway.
double least_noncentrality(double limit, int degrees, double power);

}  // namespace ols
