#include "base/journal/trouble_log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace ols {
namespace {

// What is logged of a trouble that is looked at once a second.
std::string logged_of(const std::vector<std::string>& troubles) {
  std::ostringstream said;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(said);
  const auto before = spdlog::default_logger();
  const auto logger = std::make_shared<spdlog::logger>("test", sink);
  logger->set_pattern("%l %v");
  spdlog::set_default_logger(logger);
  TroubleLog log("output");
  double now_s = 100.0;
  for (const std::string& trouble : troubles) {
    log.look("tak", trouble, now_s);
    log.look("map", "", now_s);
    now_s += 1.0;
  }
  spdlog::set_default_logger(before);
  return said.str();
}

std::vector<std::string> and_then(std::vector<std::string> troubles, const std::string& trouble) {
  troubles.insert(troubles.end(), 11, trouble);
  return troubles;
}

TEST(TroubleLog, SaysOnceWhatGoesWrongAndThatItWorksAgain) {
  EXPECT_EQ(logged_of(and_then(and_then({"", "refused", "refused"}, "no route"), "")),
            "warning output tak: refused\nwarning output tak: no route\n"
            "info output tak: works again\n");
}

TEST(TroubleLog, WhatComesAndGoesIsOneTrouble) {
  std::vector<std::string> flapping;
  for (int i = 0; i < 50; ++i) {
    flapping.insert(flapping.end(), {"nobody listens there", "", "no such folder"});
  }
  EXPECT_EQ(logged_of(and_then(flapping, "")),
            "warning output tak: nobody listens there\ninfo output tak: works again\n");
}

}  // namespace
}  // namespace ols
