// Asserts that two matrices are equal within a tolerance per element, and prints them if they
// differ.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace ols::test {

inline testing::AssertionResult near(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected,
                                     double tolerance) {
  if (actual.rows() == expected.rows() && actual.cols() == expected.cols() &&
      ((actual - expected).array().abs() <= tolerance).all()) {
    return testing::AssertionSuccess();
  }
  return testing::AssertionFailure() << "actual\n"
                                     << actual << "\nexpected\n"
                                     << expected << "\ntolerance " << tolerance;
}

}  // namespace ols::test
