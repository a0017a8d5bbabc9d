#include "wire/order.h"

#include <gtest/gtest.h>

namespace ols::wire {
namespace {

TEST(Order, EachKindHasANameThatLeadsBackToIt) {
  for (const Kind kind :
       {Kind::kDesignate, Kind::kPoint, Kind::kStop, Kind::kRelease, Kind::kRearm, Kind::kHome,
        Kind::kReferenceOk, Kind::kRecord, Kind::kRate, Kind::kLens, Kind::kCentre, Kind::kLook}) {
    ASSERT_FALSE(name(kind).empty());
    EXPECT_EQ(kind_named(name(kind)), kind);
  }
  EXPECT_FALSE(kind_named("dance"));
  EXPECT_FALSE(kind_named(""));
}

// A joystick's order moves the unit for its lease, so that is as short as a station wants it.
TEST(Order, ARateHasTheLeaseOfAJoystick) {
  EXPECT_EQ(lease_s({.kind = Kind::kRate}), 0.3);
  EXPECT_EQ(lease_s({.kind = Kind::kLens, .lens_rates = true}), 0.3);
  EXPECT_EQ(lease_s({.kind = Kind::kLens}), kLease_s);
  EXPECT_EQ(lease_s({.kind = Kind::kPoint}), kLease_s);
}

}  // namespace
}  // namespace ols::wire
