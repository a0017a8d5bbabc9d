#include "edge/skyline/saved_skyline.h"

#include <gtest/gtest.h>

#include <cinttypes>
#include <cstdio>

#include "base/files/fnv1a.h"
#include "geometry/angles.h"

namespace ols::skyline {
namespace {

const SkylineOwner kOwner{"alfa", 4711, 0xfedcba9876543210U};

SavedSkyline saved() {
  SavedSkyline saved{kOwner, {}};
  saved.skyline.begun_us = 1'700'000'000'000'000;
  saved.skyline.camera_ecef = {4e6, 1e6, 4.9e6};
  saved.skyline.crests.set(0, {radians(1.5), radians(0.01), 2000.0, false});
  saved.skyline.crests.set(7199, {radians(-2.25), radians(0.02), 0.0, true});
  return saved;
}

std::string refusal_of(const std::string& text) {
  const auto read = saved_skyline_from(text);
  const auto* wrong = std::get_if<std::string>(&read);
  return wrong != nullptr ? *wrong : "";
}

// With a sum that fits.
std::string with(const std::string& from, const std::string& to) {
  std::string text = to_text(saved());
  text = text.substr(0, text.rfind("sum "));
  text.replace(text.find(from), from.size(), to);
  char sum[32];
  std::snprintf(sum, sizeof sum, "sum %016" PRIx64 "\n", fnv1a(text));
  return text + sum;
}

TEST(SavedSkyline, IsReadAsItWasWritten) {
  const auto read = saved_skyline_from(to_text(saved()));
  ASSERT_TRUE(std::holds_alternative<SavedSkyline>(read)) << std::get<std::string>(read);
  const SavedSkyline& found = std::get<SavedSkyline>(read);
  EXPECT_EQ(found.owner, kOwner);
  EXPECT_EQ(found.skyline.begun_us, saved().skyline.begun_us);
  EXPECT_EQ(found.skyline.camera_ecef, saved().skyline.camera_ecef);
  EXPECT_EQ(found.skyline.crests.count(), 2);
  const auto last = found.skyline.crests.sector(71).at(0);
  EXPECT_EQ(last.column, 7199);
  EXPECT_NEAR(degrees(last.crest.elevation_rad), -2.25, 1e-5);
  EXPECT_NEAR(degrees(last.crest.sd_rad), 0.02, 1e-5);
  EXPECT_EQ(last.crest.hides_from_m, 0.0);
  EXPECT_TRUE(last.crest.disagrees);
  EXPECT_EQ(why_not_used(found, kOwner), "");
}

TEST(SavedSkyline, AnotherStationsAndAnotherCalibrationsAreNotUsed) {
  EXPECT_EQ(why_not_used(saved(), {"bravo", 4711, kOwner.chain}), "is of station alfa");
  EXPECT_EQ(why_not_used(saved(), {"alfa", 4712, kOwner.chain}),
            "is of calibration 4711, not of 4712");
  EXPECT_EQ(why_not_used(saved(), {"alfa", 4711, 1}), "is of another heading, tilt or mounting");
}

TEST(SavedSkyline, AnotherHeadingTiltOrMountingIsAnotherChain) {
  const auto differs = [](const auto& change) {
    ChainParameters chain;
    change(chain);
    return chain_hash(chain) != chain_hash({});
  };
  EXPECT_FALSE(differs([](auto&) {}));
  EXPECT_TRUE(differs([](auto& c) { c.heading_rad = radians(0.01); }));
  EXPECT_TRUE(differs([](auto& c) { c.tilt_x_rad = radians(0.01); }));
  EXPECT_TRUE(differs([](auto& c) { c.mount_y_rad = radians(0.01); }));
  EXPECT_TRUE(differs([](auto& c) { c.pan_zero_rad = radians(0.01); }));
  EXPECT_TRUE(differs([](auto& c) { c.pan_sign = -1; }));
}

TEST(SavedSkyline, WhatIsDamagedIsNamed) {
  const std::string text = to_text(saved());
  EXPECT_EQ(refusal_of(""), "line 1: is not a saved skyline");
  EXPECT_EQ(refusal_of("ols-pose 1\n"), "line 1: is not a saved skyline");
  for (std::size_t size = 14; size < text.size(); ++size) {
    EXPECT_EQ(refusal_of(text.substr(0, size)), "is damaged: wrong checksum") << size;
  }
  std::string changed = text;
  changed[changed.find("1.50000")] = '7';
  EXPECT_EQ(refusal_of(changed), "is damaged: wrong checksum");
  const std::string is_not = ": is not that of a saved skyline";
  EXPECT_EQ(refusal_of(with("1.5", "1.6")), "");
  EXPECT_EQ(refusal_of(with("alfa", "alfa bravo")), "line 2" + is_not);
  EXPECT_EQ(refusal_of(with("chain fedc", "chain xedc")), "line 4" + is_not);
  EXPECT_EQ(refusal_of(with("begun", "ended")), "line 5" + is_not);
  EXPECT_EQ(refusal_of(with("4000000.000 ", "")), "line 6" + is_not);
  EXPECT_EQ(refusal_of(with("1.50000", "nan")), "line 7" + is_not);
  EXPECT_EQ(refusal_of(with("1.50000", "91")), "line 7" + is_not);
  EXPECT_EQ(refusal_of(with("0.01000", "0.0")), "line 7" + is_not);
  EXPECT_EQ(refusal_of(with("2000.0", "-1")), "line 7" + is_not);
  EXPECT_EQ(refusal_of(with("7199", "7200")), "line 8" + is_not);
  EXPECT_EQ(refusal_of(with("7199", "0")), "line 8" + is_not) << "twice";
  EXPECT_EQ(refusal_of(with("0.0 1\n", "0.0 2\n")), "line 8" + is_not);
  EXPECT_EQ(refusal_of(with("0.0 1\n", "0.0\n")), "line 8" + is_not);
}

}  // namespace
}  // namespace ols::skyline
