#include "bridge/bridge_config.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"

namespace ols::bridge {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

BridgeConfig parsed(const std::string& text) { return parse_bridge_config(text, "bridge.toml"); }

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { parsed(text); });
}

TEST(BridgeConfig, BridgesASiteAndStoresNothingByDefault) {
  const BridgeConfig config = parsed("");
  EXPECT_EQ(config.role, Role::kSite);
  EXPECT_FALSE(config.archive.is_on);
  EXPECT_FALSE(config.ownership.is_on);
  EXPECT_FALSE(config.targets);
  EXPECT_THAT(config.commands, ElementsAre("slew", "occlusion"));
  EXPECT_TRUE(passage_of(config).takes.empty());
}

TEST(BridgeConfig, ARegionTakesItsOwnSites) {
  const PassageConfig passage = passage_of(parsed("role = \"region\"\nregion = \"north\"\n"));
  ASSERT_EQ(passage.takes.size(), 1U);
  EXPECT_TRUE(passage.takes[0].has({Kind::kBearing, "north", "any", "alfa"}));
  EXPECT_FALSE(passage.takes[0].has({Kind::kBearing, "south", "any", "alfa"}));
}

TEST(BridgeConfig, WhatCannotBeIsNamed) {
  EXPECT_THAT(error_of("region = \"a.b\"\n"), HasSubstr("bridge.toml:1: region"));
  // A stream's name has both, between _.
  EXPECT_THAT(error_of("region = \"a_b\"\n"), HasSubstr("bridge.toml:1: region"));
  EXPECT_THAT(error_of("site = \"b_c\"\n"), HasSubstr("bridge.toml:1: site"));
  EXPECT_THAT(error_of("[archive]\nsources = [\"b_c\"]\n"), HasSubstr("archive.sources"));
  EXPECT_EQ(error_of("stations = [\"a_b\"]\n"), "");
  EXPECT_THAT(error_of("stations = [\"*\"]\n"), HasSubstr("stations"));
  EXPECT_THAT(error_of("takes = [\"alfa\"]\n"), HasSubstr("REGION.SITE.STATION"));
  EXPECT_THAT(error_of("stations = [\"a\"]\ntakes = [\"r.s.a\"]\n"), HasSubstr("goes out"));
  EXPECT_THAT(error_of("commands = [\"reboot\"]\n"), HasSubstr("is not a command that crosses"));
  EXPECT_THAT(error_of("[nats]\nservers = [\"http://a\"]\n"), HasSubstr("neither nats://"));
  EXPECT_THAT(error_of("[nats]\nservers = []\n"), HasSubstr("must name one"));
  const std::string tls = "[nats]\nservers = [\"tls://a:1\"]\n";
  EXPECT_THAT(error_of(tls + "certificate = \"a\"\n"), HasSubstr("belong together"));
  EXPECT_EQ(error_of(tls + "certificate = \"a\"\nkey = \"b\"\nauthority = \"c\"\n"), "");
  EXPECT_THAT(error_of("[nats]\nservers = [\"tls://a:1\", \"nats://a:1\"]\n"),
              HasSubstr("bridge.toml:2: nats.servers: either all are tls://"));
  EXPECT_THAT(error_of("[nats]\nauthority = \"a\"\n"),
              HasSubstr("bridge.toml:2: nats.authority: only with"));
  EXPECT_THAT(error_of("[nats]\ncertificate = \"a\"\nkey = \"b\"\n"),
              HasSubstr("nats.certificate: only with"));
  EXPECT_THAT(error_of("[nats]\ncredentials = \"a\"\nnkey = \"U\"\n"), HasSubstr("either"));
  EXPECT_THAT(error_of("[archive]\nsources = [\"a.b\"]\n"), HasSubstr("archive.sources"));
  EXPECT_THAT(error_of("[ownership]\ncell_deg = [50.0, 1.0, 49.0, 2.0]\n"), HasSubstr("south"));
  EXPECT_THAT(error_of("[ownership]\nshare = true\n"), HasSubstr("nothing to own"));
}

}  // namespace
}  // namespace ols::bridge
