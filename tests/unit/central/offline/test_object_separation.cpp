#include <gtest/gtest.h>

#include "central/offline/object_separation.h"
#include "tests/unit/central/scene.h"

namespace ols::fusion {
namespace {

using namespace test;

constexpr std::int64_t kStart = 1'700'000'000'000'000;

// Four stations for two seconds; each sees every target in each exposure.
std::vector<BearingMeasurement> watch(const std::vector<Eigen::Vector3d>& targets_enu) {
  std::vector<BearingMeasurement> bearings;
  for (int k = 0; k < 50; ++k) {
    for (const Eigen::Vector3d& target : targets_enu) {
      for (const Ray& ray : rays_from(square(), target, 3e-4))
        bearings.push_back(measurement_of(ray, kStart + 40'000 * k));
    }
  }
  return bearings;
}

MutableBearings all_of(std::vector<BearingMeasurement>& bearings) {
  MutableBearings pointers;
  for (BearingMeasurement& bearing : bearings) pointers.push_back(&bearing);
  return pointers;
}

TEST(ObjectSeparation, SeesSeveralObjectsByTheDirectionsOfOneExposure) {
  auto one = watch({{10, 20, 90}});
  one.push_back(one.front());  // a duplicate points the same way
  EXPECT_FALSE(shows_several_objects(all_of(one)));
  auto two = watch({{10, 20, 90}, {-40, 30, 150}});
  EXPECT_TRUE(shows_several_objects(all_of(two)));
}

TEST(ObjectSeparation, GivesEachObjectItsBearingsFromTheFirstOn) {
  auto bearings = watch({{10, 20, 90}, {-40, 30, 150}});
  bearings.push_back(bearings.front());
  const SeparatedBearings separated = separate_objects(all_of(bearings), {}, {});
  EXPECT_EQ(separated.duplicate, 1U);
  ASSERT_EQ(separated.objects.size(), 2U);
  for (const auto& [id, own] : separated.objects) {
    EXPECT_GT(own.size(), 190U);
    EXPECT_LE(own.size(), 200U);
  }
  EXPECT_EQ(separated.unexplained + separated.objects.begin()->second.size() +
                separated.objects.rbegin()->second.size(),
            400U);
}

}  // namespace
}  // namespace ols::fusion
