// The chi-square distribution, for tests of hypotheses. Computed by Boost.Math.
#pragma once

namespace ols {

// The critical value of a chi-square, the sum of the squares of `degrees` standard normal
// variables: the sum exceeds this value with probability `level`. Throws std::invalid_argument
// unless 0 < level < 1 and degrees > 0.
double chi_square_critical(double level, int degrees);

// The level of a one-sided test with the limit `sigma`: the probability that a standard normal
// variable exceeds this limit.
double normal_level(double sigma);

// The power of a test: the probability that the sum exceeds `limit` if the variables have means
// other than 0. noncentrality: the sum of the squared means.
double chi_square_power(double limit, int degrees, double noncentrality);

// The inverse of chi_square_power(): the noncentrality at which the sum exceeds `limit` with
// probability `power` (Baarda's lambda_0). 0 if the central sum already exceeds it with at least
// this probability.
double least_noncentrality(double limit, int degrees, double power);

}  // namespace ols
