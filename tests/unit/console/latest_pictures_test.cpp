#include "console/latest_pictures.h"

#include <gtest/gtest.h>

namespace ols::console {
namespace {

Picture picture(const std::string& id, std::int64_t utime_us, bool is_video) {
  return {id, {{"station", id}, {"utime_us", utime_us}}, "jpeg", is_video};
}

Picture stream_unit(std::int64_t utime_us, bool is_key) {
  Picture made = picture("alfa", utime_us, true);
  made.bytes = "h264";
  made.codec = Codec::kH264;
  made.is_key = is_key;
  return made;
}

// The station and instant of the next picture of this view, and how many units of a stream it has;
// empty: none.
std::string next_of(const LatestPictures& latest, LatestPictures::View& view) {
  const auto bytes = latest.next(view);
  if (!bytes) return "";
  const Json header = Json::parse(bytes->substr(4, bytes->rfind('}') - 3));
  const std::string name = header.at("station").get<std::string>() + header.at("utime_us").dump();
  return header.contains("units") ? name + ":" + std::to_string(header.at("units").size()) : name;
}

TEST(LatestPictures, APreviewIsShownOnlyWhereNoVideoComes) {
  LatestPictures latest;
  LatestPictures::View view{{"alfa"}, Codec::kJpeg, {}};
  latest.receive(picture("alfa", 1'000'000, true));
  EXPECT_EQ(next_of(latest, view), "alfa1000000");
  latest.receive(picture("alfa", 2'000'000, false));
  EXPECT_EQ(next_of(latest, view), "");
  latest.receive(picture("alfa", 5'000'000, false));
  EXPECT_EQ(next_of(latest, view), "alfa5000000") << "the video has ended";
}

TEST(LatestPictures, EachStationGetsItsTurnOverASlowLink) {
  LatestPictures latest;
  LatestPictures::View view{{"alfa", "bravo"}, Codec::kJpeg, {}};
  std::string seen;
  for (int i = 1; i <= 4; ++i) {
    latest.receive(picture("alfa", i, true));
    latest.receive(picture("bravo", i, true));
    seen += next_of(latest, view) + " ";  // one for each two that come
  }
  EXPECT_EQ(seen, "alfa1 bravo2 alfa3 bravo4 ");
}

TEST(LatestPictures, EachBrowserGetsItsCodec) {
  LatestPictures latest;
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}}, wide{{"alfa"}, Codec::kJpeg, {}};
  latest.receive(stream_unit(1, true));
  latest.receive(picture("alfa", 2, true));
  latest.receive(stream_unit(3, false));
  EXPECT_EQ(next_of(latest, thin), "alfa3:2");
  EXPECT_EQ(next_of(latest, wide), "alfa2");
  EXPECT_EQ(next_of(latest, thin), "");
  latest.receive(stream_unit(4, false));
  EXPECT_EQ(next_of(latest, thin), "alfa4:1");
  EXPECT_EQ(next_of(latest, wide), "");
  wide.codec = Codec::kH264;
  EXPECT_EQ(next_of(latest, wide), "alfa4:3") << "from the key frame on";
}

TEST(LatestPictures, WithoutAStreamAThinViewSeesPreviews) {
  LatestPictures latest;
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}};
  latest.receive(picture("alfa", 1'000'000, false));
  EXPECT_EQ(next_of(latest, thin), "alfa1000000") << "none has come yet";
  latest.receive(stream_unit(1'500'000, true));
  EXPECT_EQ(next_of(latest, thin), "alfa1500000:1");
  latest.receive(picture("alfa", 2'000'000, false));
  EXPECT_EQ(next_of(latest, thin), "");
  latest.receive(picture("alfa", 5'000'000, false));
  EXPECT_EQ(next_of(latest, thin), "alfa5000000") << "it has ended";
}

TEST(LatestPictures, AStationThatIsGoneIsForgotten) {
  LatestPictures latest;
  latest.receive(stream_unit(1, true));
  latest.receive(picture("alfa", 1, true));
  latest.keep_only([](const std::string&) { return false; });
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}};
  EXPECT_EQ(next_of(latest, thin), "");
}

TEST(LatestPictures, TheNewestOfAllCanBeShownAgain) {
  LatestPictures latest;
  LatestPictures::View view{{"alfa"}, Codec::kJpeg, {}};
  latest.receive(picture("alfa", 1, true));
  const auto then = latest.newest();
  latest.receive(picture("alfa", 2, true));
  EXPECT_EQ(next_of(latest, view), "alfa2");
  latest.show(then);
  EXPECT_EQ(next_of(latest, view), "alfa1");
}

}  // namespace
}  // namespace ols::console
