#include "central/filter/columns.h"

// Sanitizers do not work with functions that are chosen when the program is loaded.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define OLS_ALSO_FOR_AVX __attribute__((target_clones("avx", "default")))
#else
#define OLS_ALSO_FOR_AVX
#endif

namespace ols::fusion::columns {

OLS_ALSO_FOR_AVX void subtract_square(const double* __restrict g0, const double* __restrict g1,
                                      Eigen::Index columns, Eigen::Index n, double* __restrict P) {
  for (Eigen::Index j = 0; j < columns; ++j, P += n) {
    const double a = g0[j], b = g1[j];
    for (Eigen::Index i = j; i < n; ++i) P[i] -= a * g0[i] + b * g1[i];
  }
}

OLS_ALSO_FOR_AVX void propagate(const Eigen::Matrix3d& f, Eigen::Index n,
                                const AxisColumns& columns) {
  double* __restrict const p = columns.position;
  double* __restrict const v = columns.velocity;
  double* __restrict const a = columns.acceleration;
  const double f01 = f(0, 1), f02 = f(0, 2), f11 = f(1, 1), f12 = f(1, 2), f21 = f(2, 1),
               f22 = f(2, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double velocity = v[i], acceleration = a[i];
    p[i] += f01 * velocity + f02 * acceleration;
    v[i] = f11 * velocity + f12 * acceleration;
    a[i] = f21 * velocity + f22 * acceleration;
  }
}

OLS_ALSO_FOR_AVX void scale(const double* __restrict factors, Eigen::Index n,
                            double* __restrict P) {
  for (Eigen::Index j = 0; j < n; ++j, P += n) {
    const double factor = factors[j];
    for (Eigen::Index i = j; i < n; ++i) P[i] *= factor * factors[i];
  }
}

OLS_ALSO_FOR_AVX void mix(const Parts& parts, Eigen::Index n, double* __restrict result) {
  const auto& [first, second, third] = parts;
  const double a = first.weight, b = second.weight, c = third.weight;
  const double u = first.weighted_off, v = second.weighted_off, w = third.weighted_off;
  const double* const P = first.covariance;
  const double* const Q = second.covariance;
  const double* const R = third.covariance;
  const double* const p = first.off;
  const double* const q = second.off;
  const double* const r = third.off;
  for (Eigen::Index i = 0; i < n; ++i) {
    result[i] = (a * P[i] + u * p[i]) + (b * Q[i] + v * q[i]) + (c * R[i] + w * r[i]);
  }
}

}  // namespace ols::fusion::columns
