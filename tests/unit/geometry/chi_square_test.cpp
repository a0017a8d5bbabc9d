#include "geometry/chi_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace ols {
namespace {

// scipy.stats.chi2.isf
TEST(ChiSquare, CriticalValuesAreThoseOfTheTables) {
  EXPECT_NEAR(chi_square_critical(0.05, 1), 3.8414588206941285, 1e-9);
  EXPECT_NEAR(chi_square_critical(0.05, 7), 14.067140449340167, 1e-9);
  EXPECT_NEAR(chi_square_critical(2e-4, 2), 17.034386382832476, 1e-9);
  EXPECT_NEAR(chi_square_critical(1e-12, 2), 55.262042231857095, 1e-6);
  EXPECT_NEAR(chi_square_critical(0.05, 1999), 2104.128222359781, 1e-6);
}

// scipy.stats.norm.sf
TEST(ChiSquare, LevelOfSigmasIsOneSided) {
  EXPECT_NEAR(normal_level(0.0), 0.5, 1e-15);
  EXPECT_NEAR(normal_level(3.090232306167813), 1e-3, 1e-12);
  EXPECT_NEAR(normal_level(10.0) / 7.619853024160527e-24, 1.0, 1e-9);
}

// scipy.stats.ncx2.sf
TEST(ChiSquare, PowerIsThatOfTheNoncentralDistribution) {
  EXPECT_NEAR(chi_square_power(10.8276, 1, 17.075), 0.80001052550709, 1e-9);
  EXPECT_NEAR(chi_square_power(17.03, 2, 20.0), 0.6782621385306178, 1e-9);
  EXPECT_NEAR(chi_square_power(200.0, 100, 50.0), 0.010171068120662005, 1e-9);
  EXPECT_NEAR(chi_square_power(5.0, 2, 0.0), std::exp(-2.5), 1e-12);
}

TEST(ChiSquare, NoncentralityIsBaardas) {
  // delta_0 = 4.13 at 0.1 % and 80 %.
  EXPECT_NEAR(std::sqrt(least_noncentrality(chi_square_critical(1e-3, 1), 1, 0.8)), 4.132, 1e-3);
  EXPECT_NEAR(least_noncentrality(17.034, 2, 0.8), 23.583798390715152, 1e-6);
  EXPECT_EQ(least_noncentrality(0.1, 2, 0.8), 0.0);
}

TEST(ChiSquare, RefusesWhatIsNoLevel) {
  EXPECT_THROW(chi_square_critical(0.0, 1), std::invalid_argument);
  EXPECT_THROW(chi_square_critical(std::nan(""), 1), std::invalid_argument);
  EXPECT_THROW(chi_square_critical(0.5, 0), std::invalid_argument);
}

}  // namespace
}  // namespace ols
