// The mount against a camera on loopback.
#include "edge/mount/onvif/onvif_session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <fstream>
#include <future>

#include "base/process/clocks.h"
#include "edge/mount/onvif/service_address.h"
#include "geometry/angles.h"
#include "tests/unit/edge/mount/onvif/fake_camera.h"
#include "tests/unit/eventually.h"
#include "tests/unit/temporary_folder.h"

namespace ols::onvif {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kPassword = "pass-w0rd";
const std::string kChallenge = R"(Digest realm="r", nonce="n1", qop="auth", algorithm=MD5)";
const std::string kRefused =
    "<s:Fault><s:Code><s:Value>s:Sender</s:Value><s:Subcode><s:Value>ter:NotAuthorized</s:Value>"
    "</s:Subcode></s:Code><s:Reason><s:Text>no</s:Text></s:Reason></s:Fault>";

// What a well-behaved camera says; an absolute move is a jump.
struct Body {
  std::mutex mutex;
  std::string position = R"(x="0" y="0")";
  bool answers_options = true;  // else with another answer, as ipycam does
  bool relative_only = false;

  std::string answer(const std::string& name, const std::string& request) {
    const std::lock_guard lock(mutex);
    const auto space = [](const std::string& space) {
      return "<" + space +
             "><URI>u</URI><XRange><Min>-1</Min><Max>1</Max></XRange><YRange><Min>-1"
             "</Min><Max>1</Max></YRange></" +
             space + ">";
    };
    std::string content;
    if (name == "GetSystemDateAndTime")
      content =
          "<UTCDateTime><Time><Hour>7</Hour><Minute>50</Minute><Second>45</Second></Time><Date>"
          "<Year>2010</Year><Month>9</Month><Day>16</Day></Date></UTCDateTime>";
    if (name == "GetCapabilities")
      content =
          "<Capabilities><Media><XAddr>http://192.168.1.9/m</XAddr></Media><PTZ><XAddr>"
          "http://192.168.1.9/p</XAddr></PTZ></Capabilities>";
    if (name == "GetDeviceInformation")
      content =
          "<Manufacturer>Maker</Manufacturer><Model>M</Model><SerialNumber> 17 </SerialNumber>";
    if (name == "GetProfiles")
      content =
          "<Profiles token=\"a\"><PTZConfiguration token=\"c\"><NodeToken>n</NodeToken>"
          "</PTZConfiguration></Profiles>";
    const std::string spaces = relative_only ? space("RelativePanTiltTranslationSpace")
                                             : space("AbsolutePanTiltPositionSpace") +
                                                   space("ContinuousPanTiltVelocitySpace");
    if (name == "GetConfigurationOptions") {
      if (!answers_options) return "<GetConfigurationsResponse/>";
      content =
          "<PTZConfigurationOptions><Spaces>" + spaces + "</Spaces></PTZConfigurationOptions>";
    }
    if (name == "GetNode")
      content =
          "<PTZNode token=\"n\"><SupportedPTZSpaces>" + spaces + "</SupportedPTZSpaces></PTZNode>";
    if (name == "GetStatus")
      content = "<PTZStatus><Position><PanTilt " + position + "/></Position></PTZStatus>";
    if (name == "AbsoluteMove") {
      const std::size_t x = request.find("x=\"");
      position = request.substr(x, request.find("/>", x) - x);
    }
    return "<" + name + "Response>" + content + "</" + name + "Response>";
  }
};

struct OnvifMountTest : ::testing::Test {
  OnvifConfig config(const FakeCamera& camera, const std::string& password = kPassword) {
    OnvifConfig config;
    config.url = camera.url();
    config.user = "operator";
    config.password_file = file;
    write(password);
    config.timeout_s = 20.0;
    config.drive.pan = {0.0, radians(180.0), radians(50.0)};
    config.drive.tilt = {0.0, radians(90.0), radians(50.0)};
    return config;
  }
  void write(const std::string& password) { std::ofstream(file) << password << "\n"; }

  TemporaryFolder folder;
  std::string file = folder / "password";
  Body body;
};

std::string alarms(const mount::Mount& mount) {
  std::string text;
  for (const Alarm& alarm : mount.report().alarms) text += alarm.text + "\n";
  return text;
}

FakeCamera::Answer by_digest(Body& body, const std::string& name,
                             const FakeCamera::Request& request) {
  const std::string login(request[boost::beast::http::field::authorization]);
  if (name != "GetSystemDateAndTime" && !login.starts_with("Digest username=\"operator\""))
    return {401, "", kChallenge};
  return {200, body.answer(name, request.body())};
}

TEST_F(OnvifMountTest, LogsInStopsFirstGoesToAGoalAndStopsAtTheEnd) {
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    return by_digest(body, name, request);
  });
  {
    mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
    ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
    EXPECT_EQ(mount.reference(), mount::Reference::kTrusted);
    EXPECT_EQ(camera.count("ContinuousMove") + camera.count("AbsoluteMove"), 0u);
    EXPECT_GE(camera.count("Stop"), 1u);
    double pan_rad = 0.0;
    ASSERT_TRUE(eventually([&] {
      const double now_s = clock_monotonic_s();
      mount.set_goal(mount::Goal{now_s, {radians(1.8), 0.0}, {}, now_s + 1.0, false, true});
      for (const mount::AngleSample& sample : mount.take_samples()) pan_rad = sample.angles.pan_rad;
      return std::abs(pan_rad - radians(1.8)) < 1e-6;
    }));
    EXPECT_EQ(mount.report().state, device::DeviceState::kOk);
    EXPECT_THAT(mount.report().text, HasSubstr("absolute continuous"));
    EXPECT_THAT(mount.report().text, HasSubstr("ONVIF Maker M, serial 17: moves"));
    EXPECT_EQ(mount.report().serial, "17");
  }
  EXPECT_EQ(camera.names().back(), "Stop");
  EXPECT_THAT(camera.all_bytes(), Not(HasSubstr(kPassword)));
}

using Names = std::vector<std::string>;

// The first five requests from `begin` on, without repetitions: libcurl sends a request twice to
// log in by digest.
Names five(const Names& all, Names::const_iterator begin) {
  Names names(begin, all.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  names.resize(5);
  return names;
}

Names first_five(const FakeCamera& camera) {
  const Names all = camera.names();
  return five(all, all.begin());
}

Names five_after_status(const FakeCamera& camera) {
  const Names all = camera.names();
  return five(all, std::find(all.begin(), all.end(), "GetStatus") + 1);
}

const FakeCamera::Answer kBreaks{200, std::string(HttpLink::kLongestAnswer, ' ')};

TEST_F(OnvifMountTest, AStopIsOrderedAsSoonAsTheProfileIsKnown) {
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    return by_digest(body, name, request);
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
  EXPECT_THAT(first_five(camera), ElementsAre("GetSystemDateAndTime", "GetCapabilities",
                                              "GetProfiles", "Stop", "GetDeviceInformation"));
}

TEST_F(OnvifMountTest, TheFirstRequestOfALaterConnectionIsAStop) {
  for (const bool digest : {true, false}) {
    std::atomic<bool> breaks = true;
    FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
      if (name == "GetStatus" && breaks.exchange(false)) return kBreaks;
      if (digest) return by_digest(body, name, request);
      const bool has_token = request.body().find("Created") != std::string::npos;
      if (name != "GetSystemDateAndTime" && !has_token) return FakeCamera::Answer{400, kRefused};
      return FakeCamera::Answer{200, body.answer(name, request.body())};
    });
    mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
    ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
    EXPECT_THAT(five_after_status(camera), ElementsAre("Stop", "GetSystemDateAndTime",
                                                       "GetCapabilities", "GetProfiles", "Stop"));
  }
}

TEST_F(OnvifMountTest, AFirstStopThatIsRefusedIsOrderedAgainWithALoginOfItsOwn) {
  std::atomic<bool> breaks = true, refuses = false;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    if (name == "GetStatus" && breaks.exchange(false)) return refuses = true, kBreaks;
    if (name == "Stop" && refuses.exchange(false)) return FakeCamera::Answer{401, ""};
    return by_digest(body, name, request);
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
  EXPECT_THAT(five_after_status(camera), ElementsAre("Stop", "GetSystemDateAndTime",
                                                     "GetCapabilities", "GetProfiles", "Stop"));
  EXPECT_EQ(mount.report().counters.count("ptu_logins_refused"), 0u);
}

TEST_F(OnvifMountTest, ACameraThatIsNoMountIsStoppedAllTheSame) {
  body.relative_only = true;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    return by_digest(body, name, request);
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  ASSERT_TRUE(eventually([&] { return alarms(mount).find("no moves") != std::string::npos; }));
  EXPECT_GE(camera.count("Stop"), 1u);
}

TEST_F(OnvifMountTest, AStationThatEndsWithoutAConnectionOrdersTheStopOnANewOne) {
  std::atomic<bool> breaks = false;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    if (breaks && name != "Stop") return kBreaks;
    return by_digest(body, name, request);
  });
  {
    mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
    ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
    breaks = true;
    ASSERT_TRUE(eventually([&] { return !mount.limits().has_value(); }));
  }
  EXPECT_EQ(camera.names().back(), "Stop");
}

TEST_F(OnvifMountTest, ACameraThatAnswersForItsNodeAloneIsAMountToo) {
  body.answers_options = false;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    return by_digest(body, name, request);
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  EXPECT_TRUE(eventually([&] { return mount.limits().has_value(); }));
  EXPECT_THAT(mount.report().text, HasSubstr("absolute continuous"));
}

TEST_F(OnvifMountTest, ARefusedPasswordIsTriedOnceUntilTheFileChanges) {
  std::atomic<int> tries = 0;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    if (name == "GetSystemDateAndTime") return FakeCamera::Answer{200, body.answer(name, "")};
    tries += request[boost::beast::http::field::authorization].empty() ? 0 : 1;
    return FakeCamera::Answer{401, "", kChallenge};
  });
  mount::DrivenMount mount(config(camera, "wrong").drive,
                           std::make_unique<OnvifSession>(config(camera, "wrong")));
  ASSERT_TRUE(eventually([&] { return alarms(mount).find("refused") != std::string::npos; }));
  EXPECT_EQ(tries, 1);
  EXPECT_EQ(mount.report().state, device::DeviceState::kFault);
  EXPECT_FALSE(mount.limits());
  write("wrong, too");
  ASSERT_TRUE(eventually([&] { return tries == 2; }));
}

TEST_F(OnvifMountTest, ATokenHasTheTimeOfTheCamerasClock) {
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    const bool open = name == "GetSystemDateAndTime" || name == "GetCapabilities";
    if (!open && request.body().find("Created") == std::string::npos)
      return FakeCamera::Answer{400, kRefused};
    return FakeCamera::Answer{200, body.answer(name, request.body())};
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
  EXPECT_THAT(camera.all_bytes(), HasSubstr(">2010-09-16T07:5"));
  EXPECT_THAT(camera.all_bytes(), Not(HasSubstr(kPassword)));
}

TEST_F(OnvifMountTest, AnEmergencyDoesNotWaitForAnAnswerThatIsDue) {
  std::promise<void> released;
  const auto release = released.get_future().share();
  std::atomic<bool> hangs = false;
  std::atomic<std::size_t> stops = 0;
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    if (name == "Stop") ++stops;
    if (name == "GetStatus" && hangs.exchange(false)) release.wait();
    return FakeCamera::Answer{200, body.answer(name, request.body())};
  });
  {
    mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
    ASSERT_TRUE(eventually([&] { return mount.limits().has_value(); }));
    const std::size_t before = stops;
    hangs = true;
    ASSERT_TRUE(eventually([&] { return !hangs; }));
    mount.emergency_halt();
    EXPECT_TRUE(eventually([&] { return stops > before; }, 15.0));  // the time-out is 20 s
    EXPECT_THAT(alarms(mount), HasSubstr("emergency stop"));
    released.set_value();
  }
}

TEST_F(OnvifMountTest, ACameraWithoutPositionsIsToldAndIsNoMount) {
  FakeCamera camera([&](const std::string& name, const FakeCamera::Request& request) {
    if (name == "GetStatus")
      return FakeCamera::Answer{200, "<GetStatusResponse><PTZStatus/></GetStatusResponse>"};
    return FakeCamera::Answer{200, body.answer(name, request.body())};
  });
  mount::DrivenMount mount(config(camera).drive, std::make_unique<OnvifSession>(config(camera)));
  ASSERT_TRUE(eventually([&] { return alarms(mount).find("no Position") != std::string::npos; }));
  EXPECT_FALSE(mount.limits());
}

TEST(OnvifAddress, ThePasswordGoesToTheConfiguredHostAlone) {
  for (const auto& [configured, stated, expected] : std::vector<std::array<std::string, 3>>{
           {"http://cam:8080/d", "http://10.0.0.5/onvif/ptz", "http://cam:8080/onvif/ptz"},
           {"http://cam:8080/d", "http://cam:81/p?x=1", "http://cam:81/p?x=1"},
           {"https://cam:8443/d", "http://10.0.0.5:80/p", "https://cam:8443/p"},
           {"http://[fe80::1]:80/d", "http://[fe80::1]:81/p", "http://[fe80::1]:81/p"},
           {"http://cam/d", "http://evil@x/p", "http://cam/p"},
           {"http://cam/d", "http://x:@evil/p", "http://cam/d"},
           {"http://cam/d", "file:///etc/passwd", "http://cam/d"},
           {"http://cam/d", "", "http://cam/d"}}) {
    EXPECT_EQ(service_address(configured, stated), expected) << stated;
  }
  for (const auto& [stated, expected] : std::vector<std::array<std::string, 2>>{
           {"rtsp://10.0.0.5:554/v?x=1", "rtsp://cam:554/v?x=1"},
           {"rtsp://u:p@10.0.0.5/v", "rtsp://cam/v"},
           {"rtsp://10.0.0.5/v@1", "rtsp://cam/v@1"},
           {"http://cam/v", ""},
           {"rtsp:", ""},
           {"", ""}}) {
    EXPECT_EQ(stream_address("http://cam:8080/d", stated), expected) << stated;
  }
  EXPECT_EQ(service_address("http://cam/d", "rtsp://cam/v"), "http://cam/d");
  EXPECT_THROW(check_address("http://u:p@cam/d"), std::invalid_argument);
  EXPECT_THROW(check_address("rtsp://cam/d"), std::invalid_argument);
  EXPECT_EQ(shown_address("http://cam:81/d?password=p"), "http://cam:81/...");
}

}  // namespace
}  // namespace ols::onvif
