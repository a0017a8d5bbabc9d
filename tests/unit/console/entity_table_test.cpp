#include "console/entity_table.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

TEST(EntityTable, OnlyWhatDiffersHasChanged) {
  EntityTable table(10);
  Revision revision = 0;
  table.set("a", {{"x", 1}, {"y", 2}}, 0.0, revision);
  const Revision before = revision;
  table.set("a", {{"x", 1}, {"y", 3}}, 0.1, revision);
  EXPECT_EQ(table.changed(before), Json::parse(R"([{"id":"a","y":3}])"));
  const Revision after = revision;
  table.set("a", {{"x", 1}, {"y", 3}}, 0.2, revision);
  EXPECT_EQ(revision, after);
  EXPECT_TRUE(table.changed(after).empty());
}

TEST(EntityTable, WhatFallsSilentIsStaleThenGone) {
  EntityTable table(10);
  Revision revision = 0;
  table.set("a", {{"x", 1}}, 0.0, revision);
  EXPECT_TRUE(table.age(1.0, 2.0, 10.0, revision).empty());
  EXPECT_EQ(table.age(3.0, 2.0, 10.0, revision), std::vector<std::string>{"a"});
  EXPECT_TRUE(table.age(3.1, 2.0, 10.0, revision).empty()) << "told once";
  EXPECT_TRUE(table.find("a")->at("stale"));
  EXPECT_EQ(table.stale(), 1U);
  const Revision before = revision;
  static_cast<void>(table.age(11.0, 2.0, 10.0, revision));
  EXPECT_EQ(table.find("a"), nullptr);
  EXPECT_EQ(*table.gone(before), Json::parse(R"(["a"])"));
}

TEST(EntityTable, IsBoundedAndPrefersTheLiving) {
  EntityTable table(2);
  Revision revision = 0;
  EXPECT_TRUE(table.set("a", {{"x", 1}}, 0.0, revision));
  EXPECT_TRUE(table.set("b", {{"x", 1}}, 5.0, revision));
  EXPECT_FALSE(table.set("c", {{"x", 1}}, 5.0, revision));
  static_cast<void>(table.age(5.0, 2.0, 100.0, revision));
  EXPECT_TRUE(table.set("c", {{"x", 1}}, 5.0, revision)) << "in the place of the silent one";
  EXPECT_EQ(table.find("a"), nullptr);
}

TEST(EntityTable, RemovalsLongAgoAreNotKnownAnyMore) {
  EntityTable table(5000);
  Revision revision = 0;
  for (int i = 0; i < 2000; ++i) table.set(std::to_string(i), {{"x", 1}}, 0.0, revision);
  const Revision before = revision;
  table.clear(revision);
  EXPECT_FALSE(table.gone(before));
  EXPECT_TRUE(table.gone(revision));
}

TEST(EntityTable, WhatCameBackIsNotGone) {
  EntityTable table(5);
  Revision revision = 0;
  table.set("a", {{"x", 1}}, 0.0, revision);
  const Revision before = revision;
  table.remove("a", revision);
  table.set("a", {{"x", 1}}, 0.0, revision);
  EXPECT_TRUE(table.gone(before)->empty());
  EXPECT_EQ(table.changed(before).at(0).at("x"), 1);
}

}  // namespace
}  // namespace ols::console
