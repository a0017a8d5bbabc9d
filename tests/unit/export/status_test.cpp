#include "export/status.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace ols::exports {
namespace {

TEST(ExportStatus, SaysHowEachOutputIs) {
  ExportStatus status;
  status.targets = 3;
  status.outputs.emplace_back("tak", OutletReport{.is_open = true, .sent = 12});
  status.outputs.emplace_back("home", OutletReport{.trouble = "broker:1883: refused"});
  EXPECT_EQ(in_one_line(status), "3 targets; tak: 12 sent; home: broker:1883: refused");
  const auto json = nlohmann::json::parse(to_json(status));
  EXPECT_EQ(json.at("outputs").at("tak").at("sent"), 12);
  EXPECT_EQ(json.at("outputs").at("home").at("open"), false);
}

}  // namespace
}  // namespace ols::exports
