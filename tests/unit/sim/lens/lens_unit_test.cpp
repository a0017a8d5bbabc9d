#include "sim/lens/lens_unit.h"

#include <gtest/gtest.h>

namespace ols::sim {
namespace {

std::string raw(std::initializer_list<int> values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST(LensUnit, TakesItsTravelTimeAndSaysWhenItIsThere) {
  LensUnit unit(LensUnitConfig{.zoom_travel_s = 4.0}, 0.0);
  unit.receive(raw({0x81, 0x01, 0x04, 0x47, 0x02, 0x00, 0x00, 0x00, 0xff}), 1.0);
  EXPECT_EQ(unit.transmit(1.1), raw({0x90, 0x41, 0xff})) << "acknowledged at once";
  EXPECT_NEAR(unit.zoom_at(2.0), 0.25, 1e-9);
  EXPECT_EQ(unit.transmit(2.9), "");
  EXPECT_EQ(unit.transmit(3.1), raw({0x90, 0x51, 0xff})) << "done after half of four seconds";
  EXPECT_NEAR(unit.zoom_at(9.0), 0.5, 1e-9);
  EXPECT_NEAR(unit.zoom_at(1.5), 0.125, 1e-9) << "exposures ask a little later";
}

TEST(LensUnit, DrivesUntilItIsToldToStandAndNoFurtherThanItsEnds) {
  LensUnit unit(LensUnitConfig{.zoom_travel_s = 2.0}, 0.0);
  unit.receive(raw({0x81, 0x01, 0x04, 0x07, 0x27, 0xff}), 1.0);
  unit.receive(raw({0x81, 0x01, 0x04, 0x07, 0x00, 0xff}), 2.0);
  EXPECT_NEAR(unit.zoom_at(5.0), 0.5, 1e-9);
  unit.receive(raw({0x81, 0x01, 0x04, 0x07, 0x27, 0xff}), 5.0);
  EXPECT_EQ(unit.zoom_at(50.0), 1.0);
  unit.receive(raw({0x81, 0x01, 0x04, 0x07, 0x33, 0xff}), 50.0);
  EXPECT_NEAR(unit.zoom_at(51.0), 0.75, 1e-9) << "the fourth of eight speeds";
}

TEST(LensUnit, AnswersQuestionsAndRefusesWhatItDoesNotKnow) {
  LensUnit unit({}, 0.0);
  unit.receive(raw({0x81, 0x09, 0x04, 0x47, 0xff}), 1.0);
  EXPECT_EQ(unit.transmit(2.0), raw({0x90, 0x50, 0, 0, 0, 0, 0xff}));
  unit.receive(raw({0x81, 0x01, 0x04, 0x99, 0x00, 0xff}), 2.0);
  EXPECT_EQ(unit.transmit(3.0), raw({0x90, 0x60, 0x02, 0xff}));
  unit.receive(raw({0x82, 0x09, 0x04, 0x47, 0xff}), 3.0);
  EXPECT_EQ(unit.transmit(4.0), "") << "another device is meant";
  unit.receive(raw({0x81, 0x01, 0x04, 0x08, 0x22, 0xff}), 4.0);
  EXPECT_EQ(unit.transmit(5.0), raw({0x90, 0x61, 0x41, 0xff})) << "its focus is automatic";
  unit.receive(raw({0x81, 0x01, 0x04, 0x38, 0x03, 0xff}), 5.0);
  static_cast<void>(unit.transmit(6.0));
  unit.receive(raw({0x81, 0x01, 0x04, 0x08, 0x33, 0xff}), 6.0);
  EXPECT_EQ(unit.transmit(6.1), raw({0x90, 0x41, 0xff, 0x90, 0x51, 0xff}));
}

TEST(LensUnit, AnswersNoSoonerThanThePictureAndTheLineAllow) {
  LensUnit unit({}, 0.0);
  unit.receive(raw({0x81, 0x09, 0x04, 0x47, 0xff}), 1.0);
  ASSERT_TRUE(unit.next_output_s());
  EXPECT_NEAR(*unit.next_output_s(), 1.0 + 1.0 / 60.0 + 7.0 * 10.0 / 9600.0, 1e-9);
}

}  // namespace
}  // namespace ols::sim
