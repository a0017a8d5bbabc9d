#include "base/bus/log_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "base/trust/trailer.h"
#include "tests/unit/base/bus/log_file.h"

namespace ols {
namespace {

std::vector<std::int64_t> times(LogReader& reader) {
  std::vector<std::int64_t> result;
  while (const auto message = reader.next()) {
    result.push_back(message->received_utime_us - kStart_us);
  }
  return result;
}

std::string target(std::int64_t after_us, const std::string& payload = "data") {
  return log_record(kStart_us + after_us, "OLS_TARGET", payload);
}

TEST(LogReader, ReadsTheSitesMessagesInOrder) {
  const LogFile log(target(0) + log_record(kStart_us, "OTHER", "x") + target(5));
  LogReader reader(log.path());
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{0, 5}));
  EXPECT_EQ(reader.garbage_bytes(), 0U);
  EXPECT_FALSE(reader.is_cut_off());
}

TEST(LogReader, GivesASignedMessageWithoutItsSignature) {
  const trust::SigningKey key(trust::Seed{1});
  const std::vector<std::uint8_t> payload{'d', 'a', 't', 'a'};
  const auto with = trust::with_trailer(key, trust::SiteKey{2}, "OLS_TARGET", payload, 0);
  const LogFile log(target(0, {with.begin(), with.end()}) + target(1));
  LogReader reader(log.path());
  for (const std::size_t trailer_bytes : {trust::kTrailerBytes, std::size_t{0}}) {
    const auto message = reader.next();
    ASSERT_TRUE(message);
    EXPECT_EQ(message->payload, payload);
    EXPECT_EQ(message->trailer.size(), trailer_bytes);
  }
}

TEST(LogReader, GoesOnBehindGarbageAndCountsIt) {
  const LogFile log("xyz" + target(1) + "\xED\xA1\xDA" + target(2));
  LogReader reader(log.path());
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(reader.garbage_bytes(), 6U);
  EXPECT_EQ(reader.damage(), "6 bytes of the log are damaged, the first is byte 0");
}

TEST(LogReader, SaysThatTheEndIsCutOff) {
  const std::string whole = target(1) + target(2);
  const LogFile log(whole.substr(0, whole.size() - 2));
  LogReader reader(log.path());
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{1}));
  EXPECT_TRUE(reader.is_cut_off());
  const std::size_t lost = target(2).size() - 2;
  EXPECT_EQ(reader.damage(), std::to_string(lost) + " bytes of the log are damaged, the first is " +
                                 "byte " + std::to_string(target(1).size()) +
                                 "; the end is cut off");
}

TEST(LogReader, ARecordThatClaimsMoreThanThereIsHidesNoOthers) {
  std::string liar = target(1);
  liar[26] = '\x10';  // of the length of its data
  const LogFile log(liar + target(2) + target(3));
  LogReader reader(log.path());
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{2, 3}));
  EXPECT_FALSE(reader.is_cut_off());
}

TEST(LogReader, SaysWhereItsReaderDidNotUnderstandAMessage) {
  const LogFile log(target(1) + target(2) + target(3));
  LogReader reader(log.path());
  static_cast<void>(reader.next());
  EXPECT_EQ(reader.damage(), "");
  reader.reject(reader.next().value());
  reader.reject(reader.next().value());
  EXPECT_EQ(reader.damage(),
            "2 messages are damaged or of another version of OLS, the first, of OLS_TARGET, is at "
            "byte " +
                std::to_string(target(1).size()));
}

std::string refusal_of(const std::string& bytes) {
  const LogFile log(bytes);
  try {
    LogReader reader(log.path());
    static_cast<void>(times(reader));
  } catch (const std::invalid_argument& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with(log.path() + ": ")) << text;
    return text.substr(log.path().size() + 2);
  }
  return "";
}

TEST(LogReader, AnotherFileIsNoLogInWhichNothingHappened) {
  EXPECT_EQ(refusal_of("root:x:0:0\n"), "is no LCM log: from byte 0 to byte 11 there is no record");
  EXPECT_EQ(refusal_of("\x1F\x8B\x08 and more"), "is compressed (gzip): decompress it first");
  EXPECT_EQ(refusal_of("\x28\xB5\x2F\xFD and more"), "is compressed (zstd): decompress it first");
  EXPECT_EQ(refusal_of(log_record(kStart_us, "OTHER", "x")),
            "is an LCM log, but has no message of a site (OLS_*)");
}

TEST(LogReader, TimeNeverGoesBackAndDoesNotLeapBeyondADay) {
  const LogFile log(target(10) + target(4) + target(200'000'000'000) + target(12));
  LogReader reader(log.path());
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{10, 10, 12}));
  EXPECT_GT(reader.garbage_bytes(), 0U);
}

TEST(LogReader, ReadsOnAfterAnySilenceWithTheTimesThatAreRecorded) {
  const LogFile log(target(10) + target(4) + target(200'000'000'000) + target(12));
  LogReader reader(log.path(), LogTimes::kAsRecorded);
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{10, 4, 200'000'000'000, 12}));
  EXPECT_EQ(reader.garbage_bytes(), 0U);
}

TEST(LogReader, ReadsFromAnyRecordOn) {
  const LogFile log(target(1) + target(2) + target(3));
  LogReader reader(log.path());
  ASSERT_TRUE(reader.next());
  const std::uint64_t second = reader.offset();
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{2, 3}));
  reader.seek(second, kStart_us + 1);
  EXPECT_EQ(reader.offset(), second);
  EXPECT_EQ(times(reader), (std::vector<std::int64_t>{2, 3}));
}

TEST(LogReader, RecordsLargerThanItsBuffer) {
  const LogFile log(target(1, std::string(1'000'000, 'a')) + target(2, std::string(300'000, 'b')));
  LogReader reader(log.path());
  EXPECT_EQ(reader.next().value().payload.size(), 1'000'000U);
  EXPECT_EQ(reader.next().value().payload.size(), 300'000U);
}

TEST(LogReader, NamesAFileThatCannotBeRead) {
  EXPECT_THROW(LogReader("/nowhere/a.lcmlog"), std::invalid_argument);
  EXPECT_THROW(LogReader("/").next(), std::invalid_argument);
  const LogFile empty("");
  EXPECT_THAT([&] { const LogReader reader(empty.path()); },
              testing::ThrowsMessage<std::invalid_argument>(empty.path() + ": is empty"));
}

}  // namespace
}  // namespace ols
