#include "console/unit_chain.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

Picture unit(std::int64_t utime_us, bool is_key, const std::string& bytes) {
  return {"alfa", {{"utime_us", utime_us}}, bytes, true, Codec::kH264, is_key};
}

// The header's instant, the units' own, and the bytes behind.
std::string said_by(const UnitChain& chain, std::uint64_t had) {
  const std::string bytes = chain.message_after(had);
  const std::size_t end = bytes.rfind('}') + 1;
  const Json header = Json::parse(bytes.substr(4, end - 4));
  EXPECT_EQ(header.at("codec"), "h264");
  return header.at("utime_us").dump() + " " + header.at("units").dump() + " " + bytes.substr(end);
}

TEST(UnitChain, ABrowserGetsWhatItHasNotHadUnderTheNewestHeader) {
  UnitChain chain;
  chain.add(unit(10, true, "key"), 4);
  chain.add(unit(20, false, "ab"), 5);
  chain.add(unit(30, false, "c"), 7);
  EXPECT_EQ(chain.newest(), 7U);
  EXPECT_EQ(chain.newest_utime_us(), 30);
  EXPECT_EQ(said_by(chain, 5), "30 [[30,1,false]] c");
  EXPECT_EQ(said_by(chain, 4), "30 [[20,2,false],[30,1,false]] abc");
}

TEST(UnitChain, WhoeverHadNoneOfItGetsAllFromTheKeyFrameOn) {
  UnitChain chain;
  chain.add(unit(10, true, "key"), 4);
  chain.add(unit(20, false, "ab"), 5);
  EXPECT_EQ(said_by(chain, 0), "20 [[10,3,true],[20,2,false]] keyab");
  EXPECT_EQ(said_by(chain, 3), said_by(chain, 0)) << "of the stream before";
}

TEST(UnitChain, AKeyFrameMakesTheRestNeedless) {
  UnitChain chain;
  chain.add(unit(10, true, "key"), 4);
  chain.add(unit(20, false, "ab"), 5);
  chain.add(unit(30, true, "new"), 6);
  EXPECT_EQ(said_by(chain, 4), "30 [[30,3,true]] new");
}

TEST(UnitChain, NothingBeforeTheFirstKeyFrame) {
  UnitChain chain;
  chain.add(unit(10, false, "ab"), 4);
  EXPECT_EQ(chain.newest(), 0U);
  EXPECT_EQ(chain.newest_utime_us(), 0);
}

TEST(UnitChain, AStreamWithoutKeyFramesDoesNotGrowForEver) {
  UnitChain chain;
  chain.add(unit(0, true, "key"), 1);
  std::uint64_t number = 1;
  while (chain.newest() != 0 && number < 10 * UnitChain::kMostUnits) {
    chain.add(unit(0, false, "x"), ++number);
  }
  EXPECT_EQ(number, UnitChain::kMostUnits + 1);
  chain.add(unit(0, true, std::string(UnitChain::kMostBytes, 'x')), ++number);
  EXPECT_EQ(chain.newest(), number);
  chain.add(unit(0, false, "x"), ++number);
  EXPECT_EQ(chain.newest(), 0U);
}

}  // namespace
}  // namespace ols::console
