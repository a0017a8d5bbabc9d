#include "edge/tracker/spectrum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace ols::tracker {
namespace {

Map random_map(unsigned seed) {
  std::mt19937 engine(seed);
  Map map;
  for (float& value : map) value = static_cast<float>(engine() % 1000) / 1000.0F;
  return map;
}

TEST(Spectrum, ThereAndBackGivesBothMapsAgain) {
  const Map a = random_map(1), b = random_map(2);
  Spectrum to_a, to_b;
  transform(a, b, to_a, to_b);
  Map back_a, back_b;
  transform_back(to_a, to_b, back_a, back_b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(back_a[i], a[i], 1e-5F) << i;
    ASSERT_NEAR(back_b[i], b[i], 1e-5F) << i;
  }
}

TEST(Spectrum, TheCorrelationPeaksAtTheShift) {
  constexpr std::size_t kRight = 5, kDown = 3;
  Spectra first{}, second{};
  const Map map = random_map(3);
  Map shifted;
  for (std::size_t i = 0; i < map.size(); ++i) {
    const std::size_t row = (i / kMapSide + kDown) % kMapSide;
    const std::size_t column = (i % kMapSide + kRight) % kMapSide;
    shifted[row * kMapSide + column] = map[i];
  }
  transform(map, shifted, first[0], second[0]);
  Map response, none;
  transform_back(correlation(first, second), Spectrum{}, response, none);
  const auto peak = std::max_element(response.begin(), response.end()) - response.begin();
  EXPECT_EQ(peak, static_cast<std::ptrdiff_t>(kDown * kMapSide + kRight));
}

}  // namespace
}  // namespace ols::tracker
