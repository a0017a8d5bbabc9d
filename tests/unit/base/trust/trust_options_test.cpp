#include "base/trust/trust_options.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace ols::trust {
namespace {

Mode mode_by(const std::string& words, const char* environment) {
  ::setenv("OLS_TRUST", environment, 1);
  CLI::App app;
  TrustConfig config;
  add_trust_options(app, config);
  app.parse(words);
  ::unsetenv("OLS_TRUST");
  return config.mode;
}

TEST(TrustOptions, WhoNamesAKeyRequiresSignatures) {
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key", ""), Mode::kRequire);
  EXPECT_EQ(mode_by("", ""), Mode::kDefault);  // no operator's key on a computer that runs tests
}

TEST(TrustOptions, WhatIsSaidGoesFirst) {
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key --trust off", ""), Mode::kOff);
  EXPECT_EQ(mode_by("--trust observe --key /nonexistent/bert.key", ""), Mode::kObserve);
  EXPECT_EQ(mode_by("--key /nonexistent/bert.key", "observe"), Mode::kDefault);  // as that says
}

}  // namespace
}  // namespace ols::trust
