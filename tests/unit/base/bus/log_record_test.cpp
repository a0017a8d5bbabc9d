#include "base/bus/log_record.h"

#include <gtest/gtest.h>

#include "tests/unit/base/bus/log_file.h"

namespace ols {
namespace {

std::variant<LogRecord, LogGarbage, LogNeedsMore> parse(const std::string& bytes) {
  return parse_log_record({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
}

TEST(LogRecord, HasTimeChannelAndData) {
  const std::string bytes = log_record(kStart_us, "OLS_TARGET", "data") + "more";
  const auto parsed = parse(bytes);
  const auto& record = std::get<LogRecord>(parsed);
  EXPECT_EQ(record.utime_us, kStart_us);
  EXPECT_EQ(record.channel, "OLS_TARGET");
  EXPECT_EQ(std::string(record.payload.begin(), record.payload.end()), "data");
  EXPECT_EQ(record.bytes, bytes.size() - 4);
}

TEST(LogRecord, SaysHowMuchIsMissingAtEachCut) {
  const std::string whole = log_record(kStart_us, "OLS_TARGET", "data");
  for (std::size_t cut = 1; cut < whole.size(); ++cut) {
    const auto parsed = parse(whole.substr(0, cut));
    ASSERT_TRUE(std::holds_alternative<LogNeedsMore>(parsed)) << cut;
    EXPECT_EQ(std::get<LogNeedsMore>(parsed).bytes, cut < 28 ? 28 : whole.size()) << cut;
  }
}

TEST(LogRecord, GarbageEndsWhereARecordMayBegin) {
  EXPECT_EQ(std::get<LogGarbage>(parse("abc\xED\xA1")).bytes, 3U);
  EXPECT_EQ(std::get<LogGarbage>(parse("abc")).bytes, 3U);
  EXPECT_EQ(std::get<LogGarbage>(parse("\xED\x01")).bytes, 2U);
}

TEST(LogRecord, ImpossibleLengthsAndNamesAreGarbage) {
  EXPECT_TRUE(std::holds_alternative<LogGarbage>(parse(log_record(kStart_us, "", "data"))));
  const std::string long_name(64, 'x');
  EXPECT_TRUE(std::holds_alternative<LogGarbage>(parse(log_record(kStart_us, long_name, "data"))));
  EXPECT_TRUE(std::holds_alternative<LogGarbage>(parse(log_record(kStart_us, "OLS TARGET", ""))));
  std::string huge = log_record(kStart_us, "OLS_TARGET", "data");
  huge[24] = '\x7f';
  EXPECT_TRUE(std::holds_alternative<LogGarbage>(parse(huge)));
}

TEST(LogRecord, WhatIsWrittenIsRead) {
  const std::vector<std::uint8_t> payload{1, 2, 3};
  const auto bytes = log_record_bytes(9, kStart_us, "OLS_SIGHTING_alfa", payload);
  const std::string as_logged(bytes.begin(), bytes.end());
  const auto parsed = parse(as_logged);
  const auto& record = std::get<LogRecord>(parsed);
  EXPECT_EQ(record.utime_us, kStart_us);
  EXPECT_EQ(record.channel, "OLS_SIGHTING_alfa");
  EXPECT_EQ(std::vector<std::uint8_t>(record.payload.begin(), record.payload.end()), payload);
  EXPECT_EQ(record.bytes, bytes.size());
}

}  // namespace
}  // namespace ols
