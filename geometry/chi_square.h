// The chi-square distribution, for tests of hypotheses, by Boost.Math.
#pragma once

namespace ols {

// The critical value: a sum of squares of `degrees` standard normal variables exceeds it with
// probability `level` (0 < level < 1). Throws std::invalid_argument for other levels or degrees.
double chi_square_critical(double level, int degrees);

// The level of a one-sided test at `sigma`: the probability that a standard normal variable exceeds
// it.
double normal_level(double sigma);

// The probability that the sum exceeds `limit`, for this noncentrality (sum of the squared means).
double chi_square_power(double limit, int degrees, double noncentrality);

// The noncentrality at which the sum exceeds `limit` with probability `power` (Baarda's lambda_0);
// 0 if the sum already does so without noncentrality.
double least_noncentrality(double limit, int degrees, double power);

}  // namespace ols
