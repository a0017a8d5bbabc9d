#include "edge/process/skyline_store.h"

#include <gtest/gtest.h>

#include <fstream>

#include "tests/unit/eventually.h"
#include "tests/unit/temporary_folder.h"

namespace ols::station {
namespace {

const skyline::SkylineOwner kOwner{"alfa", 4711, 17};

skyline::SavedSkyline saved(double elevation_rad = 0.125) {
  skyline::SavedSkyline saved{kOwner, {}};
  saved.skyline.begun_us = 7;
  saved.skyline.crests.set(30, {elevation_rad, 0.01, 2000.0, true});
  return saved;
}

class SkylineStoreTest : public testing::Test {
 protected:
  bool holds(const std::string& wanted) const {
    return eventually([&] {
      std::ifstream stream(file_);
      const std::string text{std::istreambuf_iterator<char>(stream), {}};
      return text == wanted;
    });
  }
  std::string begins_with(const std::string& text) const {
    return "skyline: the saved one is not used: " + file_ + ": " + text;
  }

  TemporaryFolder folder_;
  const std::string file_ = folder_ / "alfa.skyline";
};

TEST_F(SkylineStoreTest, WhatIsKeptIsFoundAgainOnce) {
  {
    SkylineStore store(file_);
    EXPECT_TRUE(store.trouble().empty()) << "a file that is not there yet is no trouble";
    EXPECT_FALSE(store.take_found(kOwner));
    store.keep(saved(), 100.0);
    ASSERT_TRUE(holds(to_text(saved())));
  }
  SkylineStore again(file_);
  const auto found = again.take_found(kOwner);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->begun_us, 7);
  EXPECT_EQ(found->crests.count(), 1);
  EXPECT_FALSE(again.take_found(kOwner));
}

TEST_F(SkylineStoreTest, IsWrittenEveryFewMinutes) {
  SkylineStore store(file_);
  store.keep(saved(0.1), 100.0);
  ASSERT_TRUE(holds(to_text(saved(0.1))));
  store.keep(saved(0.2), 100.0 + SkylineStore::kInterval_s - 1.0);
  store.keep(saved(0.3), 100.0 + SkylineStore::kInterval_s);
  EXPECT_TRUE(holds(to_text(saved(0.3))));
  store.drop(kOwner);
  EXPECT_TRUE(holds(skyline::to_text({kOwner, {}})));
  store.keep(saved(0.4), 101.0 + SkylineStore::kInterval_s);
  EXPECT_TRUE(holds(to_text(saved(0.4)))) << "what is seen anew is saved at once";
  store.drop(kOwner);
  EXPECT_TRUE(holds(skyline::to_text({kOwner, {}}))) << "once more";
}

TEST_F(SkylineStoreTest, WhatWasDroppedIsNoTroubleToAnotherHeading) {
  {
    SkylineStore store(file_);
    store.drop(kOwner);
    ASSERT_TRUE(holds(skyline::to_text({kOwner, {}})));
  }
  SkylineStore later(file_);
  skyline::SkylineOwner turned = kOwner;
  ++turned.chain;
  EXPECT_FALSE(later.take_found(turned));
  EXPECT_TRUE(later.trouble().empty());
}

TEST_F(SkylineStoreTest, WhatCannotBeUsedIsNamedUntilAnotherIsSaved) {
  std::ofstream(file_) << "ols-skyline 1\nstation b";
  SkylineStore damaged(file_);
  EXPECT_EQ(damaged.trouble(), begins_with("is damaged: wrong checksum"));
  damaged.keep(saved(), 0.0);
  EXPECT_TRUE(eventually([&] { return damaged.trouble().empty(); }));
  ASSERT_TRUE(holds(to_text(saved())));
  SkylineStore later(file_);
  EXPECT_FALSE(later.take_found({"alfa", 4712, 17}));
  EXPECT_EQ(later.trouble(), begins_with("is of calibration 4711, not of 4712"));
  SkylineStore other(file_);
  EXPECT_FALSE(other.take_found({"bravo", 4711, 17}));
  EXPECT_EQ(other.trouble(), begins_with("is of station alfa"));
}

TEST_F(SkylineStoreTest, AFolderThatIsNotThereIsATrouble) {
  SkylineStore store(folder_ / "none/alfa.skyline");
  store.keep(saved(), 0.0);
  EXPECT_TRUE(
      eventually([&] { return store.trouble().text.starts_with("skyline: cannot be saved: "); }));
}

TEST_F(SkylineStoreTest, WithoutAFileNothingIsKept) {
  SkylineStore store("");
  store.keep(saved(), 0.0);
  EXPECT_TRUE(store.trouble().empty());
}

}  // namespace
}  // namespace ols::station
