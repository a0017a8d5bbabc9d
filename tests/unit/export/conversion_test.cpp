#include "export/conversion.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <utility>
#include <vector>

#include "tests/unit/base/log_file.h"

namespace ols::exports {
namespace {

TEST(Convert, TellsHowFarItIsInALog) {
  const std::string first = logged_target(kStart_us, 47.5);
  const std::string both = first + logged_target(kStart_us + 1'000'000, 47.6);
  const LogFile log(both);
  const auto output = std::filesystem::temp_directory_path() / "ols_export_conversion_test.json";
  std::vector<std::pair<std::size_t, std::size_t>> told;
  const ConversionReport report =
      convert({log.path(), "", Format::kGeoJson, output.string()}, {}, {},
              [&](std::size_t done, std::size_t all) { told.emplace_back(done, all); });
  std::filesystem::remove(output);
  EXPECT_EQ(report.targets, 2U);
  EXPECT_EQ(told, (std::vector<std::pair<std::size_t, std::size_t>>{{first.size(), both.size()},
                                                                    {both.size(), both.size()}}));
}

}  // namespace
}  // namespace ols::exports
