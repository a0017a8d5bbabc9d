#include "cue/framing.h"

#include <gtest/gtest.h>

#include <ctime>
#include <random>
#include <string>
#include <string_view>

namespace ols::cues {
namespace {

using Messages = std::vector<std::string>;

Messages in_pieces(Framer& framer, const std::string& stream, std::size_t most, unsigned seed) {
  std::mt19937 generator(seed);
  Messages all;
  for (std::size_t at = 0; at < stream.size();) {
    const std::size_t size = 1 + generator() % most;
    for (auto& message : framer.take(stream.substr(at, size))) all.push_back(message);
    at += size;
  }
  return all;
}

TEST(Framing, LinesComeInAnyPieces) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    Framer framer(Framing::kLines);
    EXPECT_EQ(in_pieces(framer, "one\r\ntwo\n\nthree\nfo", 4, seed),
              (Messages{"one", "two", "three"}))
        << "seed " << seed;
  }
}

TEST(Framing, EventsAndMessagesOfTheTakProtocolMayFollowEachOther) {
  const std::string tak = std::string("\xbf\x83\x02", 3) + std::string(259, 'x');
  const std::string stream = "<event>1</event>\n <event>2</event>" + tak + "<event>3</event>";
  for (const unsigned seed : {1U, 2U, 3U}) {
    Framer framer(Framing::kCot);
    const Messages found = in_pieces(framer, stream, 50, seed);
    ASSERT_EQ(found.size(), 4U) << "seed " << seed;
    EXPECT_EQ(found[1], "<event>2</event>");
    EXPECT_EQ(found[2], "\xbf\x01\xbf" + std::string(259, 'x'));
    EXPECT_EQ(found[3], "<event>3</event>");
  }
}

TEST(Framing, AStreamWithoutAnEndIsDroppedAndCounted) {
  Framer framer(Framing::kLines);
  EXPECT_TRUE(framer.take(std::string(Framer::kLongest_bytes + 1, 'x')).empty());
  EXPECT_EQ(framer.overlong(), 1);
  EXPECT_EQ(framer.take("a\n"), Messages{"a"});
  Framer cot(Framing::kCot);
  EXPECT_TRUE(cot.take("\xbf\xff\xff\xff\xff\xff\xff\xff").empty());
  EXPECT_EQ(cot.overlong(), 1);
  EXPECT_TRUE(cot.take("\xbf" + std::string(12, '\x80')).empty()) << "a length without an end";
  EXPECT_EQ(cot.overlong(), 2);
}

TEST(Framing, MessagesOfSapientComeByTheirLength) {
  const std::string stream("\x03\0\0\0one\0\0\0\0\x03\0\0\0two", 18);
  for (std::size_t step = 1; step <= stream.size(); ++step) {
    Framer framer(Framing::kSapient);
    Messages found;
    for (std::size_t at = 0; at < stream.size(); at += step) {
      for (const auto& message : framer.take(stream.substr(at, step))) found.push_back(message);
    }
    EXPECT_EQ(found, (Messages{"one", "two"})) << step;
  }
  Framer endless(Framing::kSapient);
  EXPECT_TRUE(endless.take("HTTP/1.1 200 OK").empty());
  EXPECT_EQ(endless.overlong(), 1);
}

// Processor time for the messages of a stream that comes in pieces of this size.
std::clock_t cost(const std::string& stream, std::size_t piece_bytes, std::size_t messages) {
  Framer framer(Framing::kLines);
  const std::clock_t begin = std::clock();
  std::size_t found = 0;
  for (std::size_t at = 0; at < stream.size(); at += piece_bytes) {
    found += framer.take(std::string_view(stream).substr(at, piece_bytes)).size();
  }
  EXPECT_EQ(found, messages);
  return std::clock() - begin;
}

// One copy of the rest for each message would take a hundred times as long as in small pieces.
TEST(Framing, ManyMessagesAtOnceCostWhatTheirBytesCost) {
  constexpr std::size_t kLines = 300'000;
  std::string stream;
  for (std::size_t i = 0; i < kLines; ++i) stream += "{}\n";
  EXPECT_LT(cost(stream, stream.size(), kLines), 10 * cost(stream, 3000, kLines));
}

TEST(Framing, ADatagramIsWholeAndAnotherConnectionBeginsAnew) {
  Framer whole(Framing::kWhole);
  EXPECT_EQ(whole.take("a\nb"), Messages{"a\nb"});
  Framer lines(Framing::kLines);
  EXPECT_TRUE(lines.take("half of").empty());
  lines.clear();
  EXPECT_EQ(lines.take("whole\n"), Messages{"whole"});
}

}  // namespace
}  // namespace ols::cues
