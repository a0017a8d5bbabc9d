#include "base/trouble_log.h"

#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

namespace ols {
namespace {

TEST(TroubleLog, SaysOnceWhatGoesWrongAndThatItWorksAgain) {
  std::ostringstream said;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(said);
  const auto before = spdlog::default_logger();
  const auto logger = std::make_shared<spdlog::logger>("test", sink);
  logger->set_pattern("%l %v");
  spdlog::set_default_logger(logger);
  TroubleLog log("output");
  for (const char* trouble : {"", "refused", "refused", "no route", "", ""}) {
    log.look("tak", trouble);
    log.look("map", "");
  }
  spdlog::set_default_logger(before);
  EXPECT_EQ(said.str(),
            "warning output tak: refused\nwarning output tak: no route\n"
            "info output tak: works again\n");
}

}  // namespace
}  // namespace ols
