#include "tools/setup/onvif_answers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/setup/answers_fixture.h"
#include "tools/setup/plan.h"

namespace ols::setup {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string kUrl = "http://10.0.0.5/onvif/device_service";

onvif::Offer::Stream stream(double greatest) {
  const mount::Space space{{-greatest, greatest}, {-greatest, greatest}};
  onvif::PtzOptions can;
  can.absolute = can.continuous = space;
  return {{"main", "c", "n", "H264", 1280, 720, 25.0}, "rtsp://10.0.0.5/video", can};
}

std::string file(Values values) {
  Answers answers = read_answers(station_answers(), "a");
  answers.values.insert(answers.values.end(), values.begin(), values.end());
  return plan_station(answers).files[0].text;
}

TEST(OnvifAnswers, AStreamIsACameraAndItsMotionAMount) {
  Values values;
  add_onvif(values, kUrl, stream(1.0), {"admin", "/etc/ols/p"});
  EXPECT_TRUE(has_camera(values) && has_mount(values));
  const std::string text = file(values);
  for (const char* line :
       {"kind = \"rtsp\"", "url = \"rtsp://10.0.0.5/video\"", "width_px = 1280", "height_px = 720",
        "frame_rate_hz = 25", "kind = \"onvif\"", "profile = \"main\"", "user = \"admin\"",
        "password_file = \"/etc/ols/p\"", "pan_gain_deg = -180", "tilt_speed_deg_s = 40"})
    EXPECT_THAT(text, HasSubstr(line));
  EXPECT_EQ(words_of(stream(1.0)), "main: H264, 1280 x 720, 25 Hz, turns");
}

TEST(OnvifAnswers, APasswordInTheAddressOfAStreamIsNotWritten) {
  onvif::Offer::Stream tells = stream(1.0);
  tells.url = "rtsp://10.0.0.5/user=admin&password=geheim&channel=1";
  Values values;
  add_onvif(values, kUrl, tells, {"admin", "/etc/ols/p"});
  EXPECT_THAT(file(values), HasSubstr("/user=admin&password={password}&channel=1"));
}

TEST(OnvifAnswers, APinnedKeyIsWrittenWhereThereIsACertificate) {
  const std::string pin = "sha256//" + std::string(43, 'A') + "=";
  Values values;
  add_onvif(values, "https://10.0.0.5/onvif/device_service", stream(1.0), {"", "", pin});
  EXPECT_NE(find(values, "station.mount.pinned_key"), nullptr);
  EXPECT_EQ(find(values, "station.camera.pinned_key"), nullptr) << "rtsp has none";
  auto secure = stream(1.0);
  secure.url = "rtsps://10.0.0.5/video";
  values.clear();
  add_onvif(values, kUrl, secure, {"", "", pin});
  EXPECT_EQ(find(values, "station.mount.pinned_key"), nullptr);
  EXPECT_THAT(file(values), HasSubstr("pinned_key = \"" + pin));
}

TEST(OnvifAnswers, ACameraInDegreesHasNoScale) {
  Values values;
  add_onvif(values, kUrl, stream(175.0), {});
  EXPECT_THAT(file(values), HasSubstr("pan_gain_deg = -1  #"));
  EXPECT_THAT(file(values), Not(HasSubstr("password_file = \"/")));
}

TEST(OnvifAnswers, WhatAPersonSaysStays) {
  Values open{{"station.camera.kind", "\"rtsp\""}, {"station.mount.kind", "\"onvif\""}};
  EXPECT_TRUE(wants_onvif(open) && !has_camera(open) && !has_mount(open));
  Values values{{"station.camera.device", "\"Maker-1\""},
                {"station.mount.kind", "\"onvif\""},
                {"station.mount.pan_gain_deg", "-170.5"}};
  EXPECT_TRUE(wants_onvif(values));
  add_onvif(values, kUrl, stream(1.0), {});
  EXPECT_EQ(find(values, "station.camera.kind"), nullptr);
  EXPECT_EQ(*find(values, "station.mount.pan_gain_deg"), "-170.5");
  EXPECT_FALSE(wants_onvif(values));
}

TEST(OnvifAnswers, OneThatDoesNotTurnStandsStillUnlessItsMotionIsWanted) {
  auto still = stream(1.0);
  still.ptz.reset();
  Values values;
  add_onvif(values, kUrl, still, {});
  EXPECT_EQ(*find(values, "station.mount.kind"), "\"fixed\"");
  values = {{"station.mount.kind", "\"onvif\""}};
  EXPECT_THROW(add_onvif(values, kUrl, still, {}), std::runtime_error);
}

}  // namespace
}  // namespace ols::setup
