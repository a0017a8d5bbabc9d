#include "console/console_config.h"

#include <gtest/gtest.h>

#include "base/config/toml_config.h"
#include "tests/unit/error_text.h"

namespace ols::console {
namespace {

std::string error_of(const std::string& text) {
  return error_text<ConfigError>([&] { parse_console_config(text, "console.toml"); }, "taken");
}

TEST(ConsoleConfig, TheDefaultsServeThisHostAlone) {
  const ConsoleConfig config = parse_console_config("", "console.toml");
  EXPECT_EQ(config.address, "127.0.0.1");
  EXPECT_EQ(serving_problem(config, false), "");
}

TEST(ConsoleConfig, AwayFromLoopbackItNeedsTlsAndUsers) {
  EXPECT_EQ(error_of("address = \"0.0.0.0\"\n"),
            "console.toml:1: address: away from loopback it needs certificate and key");
  const ConsoleConfig config = parse_console_config(
      "address = \"0.0.0.0\"\ncertificate = \"c\"\nkey = \"k\"\n", "console.toml");
  EXPECT_NE(serving_problem(config, false), "");
  EXPECT_EQ(serving_problem(config, true), "");
  ConsoleConfig plain;
  plain.address = "10.0.0.1";  // by the command line
  EXPECT_NE(serving_problem(plain, true), "");
}

TEST(ConsoleConfig, WhatIsWrongIsNamed) {
  EXPECT_EQ(error_of("certificate = \"c\"\n"),
            "console.toml:1: certificate: certificate and key belong together");
  EXPECT_NE(error_of("address = \"somewhere\"\n").find("must be an IP address"), std::string::npos);
  EXPECT_EQ(parse_console_config("session_h = 2.0\n", "").session_s, 7200.0);
}

// A page of the world could point a name of its own here and so seem to be ours.
TEST(ConsoleConfig, AnswersToItsOwnNamesOnly) {
  ConsoleConfig config;
  config.host_names = {"console.site"};
  for (const char* own : {"localhost:8080", "127.0.0.1:8080", "10.1.2.3", "[::1]:8080",
                          "console.site:443", "console.site"}) {
    EXPECT_TRUE(is_own_host(config, own)) << own;
  }
  for (const char* foreign :
       {"evil.example:8080", "", "127.0.0.1.evil.example", "localhost.evil"}) {
    EXPECT_FALSE(is_own_host(config, foreign)) << foreign;
  }
}

}  // namespace
}  // namespace ols::console
