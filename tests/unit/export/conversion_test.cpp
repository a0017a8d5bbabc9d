#include "export/conversion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include "base/files/small_file.h"
#include "tests/unit/base/bus/log_file.h"
#include "tests/unit/error_text.h"

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

// The output of an earlier run, beside a log.
class DamagedLog : public testing::TestWithParam<std::pair<std::string, std::string>> {
 protected:
  DamagedLog() { std::ofstream(output_) << "earlier"; }
  ~DamagedLog() override { std::filesystem::remove(output_); }
  ConversionReport convert_to(Format format, bool skips_damage) const {
    return convert({log_.path(), "", format, output_, skips_damage}, {}, {});
  }
  std::string output() const { return read_small_file(output_, 1'000'000); }

  LogFile log_{GetParam().first};
  std::string output_ = log_.path() + ".json";
};

std::string targets(int count) {
  std::string log;
  for (int i = 0; i < count; ++i) log += logged_target(kStart_us + 100'000 * i, 47.5);
  return log;
}

// A target whose definition has changed since: another fingerprint, or another schema.
std::string of_another_version() {
  std::string record = logged_target(kStart_us, 47.5);
  record[28 + std::string("OLS_TARGET").size()] ^= 1;
  return record;
}

std::string noise_from(std::string log, std::size_t begin, std::size_t count) {
  std::uint32_t state = 1;
  for (std::size_t i = begin; i < begin + count; ++i) {
    log[i] = static_cast<char>((state = 1664525U * state + 1013904223U) >> 24U);
  }
  return log;
}

TEST_P(DamagedLog, IsRefusedWithItsPlaceAndLeavesTheEarlierFile) {
  for (const Format format : {Format::kGeoJson, Format::kCot}) {
    try {
      convert_to(format, false);
      ADD_FAILURE() << "was taken";
    } catch (const std::exception& error) {
      const std::string text = error.what();
      EXPECT_TRUE(text.starts_with(log_.path() + ": ")) << text;
      EXPECT_NE(text.find(GetParam().second), std::string::npos) << text;
    }
    EXPECT_EQ(output(), "earlier");
  }
}

const std::size_t kRecord = logged_target(kStart_us, 47.5).size();

INSTANTIATE_TEST_SUITE_P(
    Convert, DamagedLog,
    testing::Values(
        std::pair{"\x1F\x8B" + targets(3), "is compressed (gzip)"},
        std::pair{std::string("root:x:0:0:root:/root:/bin/sh\n"), "is no LCM log"},
        std::pair{noise_from(targets(9), 0, 9 * kRecord), "is no LCM log"},
        std::pair{targets(3).substr(0, 2 * kRecord + 1), "is byte " + std::to_string(2 * kRecord)},
        std::pair{targets(3).substr(0, 3 * kRecord - 1), "the end is cut off"},
        std::pair{noise_from(targets(9), 2 * kRecord, 40),
                  "is byte " + std::to_string(2 * kRecord)},
        std::pair{targets(2) + of_another_version() + targets(1),
                  "1 message is damaged or of another version of OLS, the first, of OLS_TARGET, "
                  "is at byte " +
                      std::to_string(2 * kRecord)},
        std::pair{of_another_version(), "is at byte 0"},
        std::pair{log_record(kStart_us, "OLS_FUSION_STATUS", "x"), "has no position to write"}));

TEST(Convert, EventsOfCursorOnTargetAreOneDocument) {
  const LogFile log(targets(2));
  const std::string output = log.path() + ".xml";
  convert({log.path(), "", Format::kCot, output}, {}, {});
  const std::string text = read_small_file(output, 1'000'000);
  std::filesystem::remove(output);
  EXPECT_TRUE(
      text.starts_with("<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n"
                       "<events>\n<event version=\"2.0\""));
  EXPECT_TRUE(text.ends_with("</event>\n</events>\n"));
  EXPECT_EQ(text.find("<?xml", 1), std::string::npos);
}

TEST(Convert, ATargetsPlaceIsNotWrittenAsTheSystems) {
  const LogFile log(targets(2));
  const std::string output = log.path() + ".json";
  ExportConfig config;
  config.geoid = "egm96_15.gtx";
  const auto to_courageous = [&] {
    convert({log.path(), "", Format::kCourageous, output}, config, {});
  };
  EXPECT_THAT(error_text<std::runtime_error>(to_courageous, ""),
              testing::HasSubstr("courageous demands the place of the system"));
  EXPECT_FALSE(std::filesystem::exists(output));
  config.courageous = {47.0, 13.0, 500.0};
  to_courageous();
  EXPECT_TRUE(std::filesystem::remove(output));
}

TEST(Convert, ALogThatIsCutOffAnywhereIsRefused) {
  const std::string whole = targets(2);
  for (std::size_t left = kRecord + 1; left < whole.size(); ++left) {
    const LogFile log(whole.substr(0, left));
    const std::string output = log.path() + ".json";
    const std::string text = error_text<std::exception>([&] {
      convert({log.path(), "", Format::kGeoJson, output}, {}, {});
    });
    ASSERT_THAT(text, testing::HasSubstr("the first is byte " + std::to_string(kRecord))) << left;
    ASSERT_FALSE(std::filesystem::exists(output));
  }
}

TEST(Convert, LeavesOutDamageOnlyWhereAskedAndSaysIt) {
  const LogFile log("noise" + targets(1));
  const std::string output = log.path() + ".json";
  const ConversionReport report = convert({log.path(), "", Format::kGeoJson, output, true}, {}, {});
  EXPECT_TRUE(std::filesystem::remove(output));
  EXPECT_EQ(report.targets, 1U);
  EXPECT_EQ(report.damage, "5 bytes of the log are damaged, the first is byte 0");
}

}  // namespace
}  // namespace ols::exports
