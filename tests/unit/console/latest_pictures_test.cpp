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
std::string next_of(const LatestPictures& desk, LatestPictures::View& view) {
  const auto bytes = desk.next(view);
  if (!bytes) return "";
  const Json header = Json::parse(bytes->substr(4, bytes->rfind('}') - 3));
  const std::string name = header.at("station").get<std::string>() + header.at("utime_us").dump();
  return header.contains("units") ? name + ":" + std::to_string(header.at("units").size()) : name;
}

TEST(LatestPictures, APreviewIsShownOnlyWhereNoVideoComes) {
  LatestPictures desk;
  LatestPictures::View view{{"alfa"}, Codec::kJpeg, {}};
  desk.hear(picture("alfa", 1'000'000, true));
  EXPECT_EQ(next_of(desk, view), "alfa1000000");
  desk.hear(picture("alfa", 2'000'000, false));
  EXPECT_EQ(next_of(desk, view), "");
  desk.hear(picture("alfa", 5'000'000, false));
  EXPECT_EQ(next_of(desk, view), "alfa5000000") << "the video has ended";
}

TEST(LatestPictures, EachStationGetsItsTurnOverASlowLink) {
  LatestPictures desk;
  LatestPictures::View view{{"alfa", "bravo"}, Codec::kJpeg, {}};
  std::string seen;
  for (int i = 1; i <= 4; ++i) {
    desk.hear(picture("alfa", i, true));
    desk.hear(picture("bravo", i, true));
    seen += next_of(desk, view) + " ";  // one for each two that come
  }
  EXPECT_EQ(seen, "alfa1 bravo2 alfa3 bravo4 ");
}

TEST(LatestPictures, EachBrowserGetsItsCodec) {
  LatestPictures desk;
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}}, wide{{"alfa"}, Codec::kJpeg, {}};
  desk.hear(stream_unit(1, true));
  desk.hear(picture("alfa", 2, true));
  desk.hear(stream_unit(3, false));
  EXPECT_EQ(next_of(desk, thin), "alfa3:2");
  EXPECT_EQ(next_of(desk, wide), "alfa2");
  EXPECT_EQ(next_of(desk, thin), "");
  desk.hear(stream_unit(4, false));
  EXPECT_EQ(next_of(desk, thin), "alfa4:1");
  EXPECT_EQ(next_of(desk, wide), "");
  wide.codec = Codec::kH264;
  EXPECT_EQ(next_of(desk, wide), "alfa4:3") << "from the key frame on";
}

TEST(LatestPictures, WithoutAStreamAThinViewSeesPreviews) {
  LatestPictures desk;
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}};
  desk.hear(picture("alfa", 1'000'000, false));
  EXPECT_EQ(next_of(desk, thin), "alfa1000000") << "none has come yet";
  desk.hear(stream_unit(1'500'000, true));
  EXPECT_EQ(next_of(desk, thin), "alfa1500000:1");
  desk.hear(picture("alfa", 2'000'000, false));
  EXPECT_EQ(next_of(desk, thin), "");
  desk.hear(picture("alfa", 5'000'000, false));
  EXPECT_EQ(next_of(desk, thin), "alfa5000000") << "it has ended";
}

TEST(LatestPictures, AStationThatIsGoneIsForgotten) {
  LatestPictures desk;
  desk.hear(stream_unit(1, true));
  desk.hear(picture("alfa", 1, true));
  desk.keep_only([](const std::string&) { return false; });
  LatestPictures::View thin{{"alfa"}, Codec::kH264, {}};
  EXPECT_EQ(next_of(desk, thin), "");
}

TEST(LatestPictures, TheNewestOfAllCanBeShownAgain) {
  LatestPictures desk;
  LatestPictures::View view{{"alfa"}, Codec::kJpeg, {}};
  desk.hear(picture("alfa", 1, true));
  const auto then = desk.newest();
  desk.hear(picture("alfa", 2, true));
  EXPECT_EQ(next_of(desk, view), "alfa2");
  desk.show(then);
  EXPECT_EQ(next_of(desk, view), "alfa1");
}

}  // namespace
}  // namespace ols::console
