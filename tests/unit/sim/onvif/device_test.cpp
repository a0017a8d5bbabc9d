// The simulated PTZ by its answers: what clients that nobody here wrote say of it is in
// tests/e2e/test_onvif.py.
#include "sim/onvif/device.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <openssl/evp.h>

#include <cmath>
#include <functional>

namespace ols::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr std::int64_t kStart_us = 1'800'000'000'000'000;

std::string base64(std::string_view bytes) {
  std::string text(4 * (bytes.size() / 3 + 1) + 1, '\0');
  text.resize(static_cast<std::size_t>(EVP_EncodeBlock(
      reinterpret_cast<unsigned char*>(text.data()),
      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()))));
  return text;
}

std::string digest(const std::string& nonce, const std::string& created,
                   const std::string& password) {
  const std::string text = nonce + created + password;
  std::string sha1(20, '\0');
  EVP_Digest(text.data(), text.size(), reinterpret_cast<unsigned char*>(sha1.data()), nullptr,
             EVP_sha1(), nullptr);
  return base64(sha1);
}

std::string security(const std::string& nonce, std::int64_t created_us,
                     const std::string& password) {
  constexpr const char* kWss =
      "http://docs.oasis-open.org/wss/2004/01/oasis-200401-wss-wssecurity-";
  const std::string created = date_time_of(created_us);
  return fmt::format(
      R"(<s:Header><w:Security xmlns:w="{0}secext-1.0.xsd" xmlns:u="{0}utility-1.0.xsd">)"
      "<w:UsernameToken><w:Username>admin</w:Username><w:Password>{1}</w:Password>"
      "<w:Nonce>{2}</w:Nonce><u:Created>{3}</u:Created></w:UsernameToken></w:Security></s:Header>",
      kWss, digest(nonce, created, password), base64(nonce), created);
}

struct Camera {
  // Its motion is judged without the delay of a command.
  static OnvifConfig config() {
    OnvifConfig c;
    c.unit.command_delay_s = 0.0;
    return c;
  }

  std::optional<OnvifAnswer> send(const std::string& header, const std::string& body) {
    return device.answer(
        {"POST", "/onvif/ptz_service", "",
         fmt::format(R"(<s:Envelope xmlns:s="{}" xmlns="{}" xmlns:tt="{}">{}<s:Body>{}</s:Body>)"
                     "</s:Envelope>",
                     onvif_space::kEnvelope, onvif_space::kPtz, onvif_space::kSchema, header,
                     body)},
        now_s, utime_us());
  }
  std::int64_t utime_us() const { return kStart_us + static_cast<std::int64_t>(1e6 * now_s); }

  // By the owner, to the only profile. `more`: after the profile's token.
  std::string ask(const std::string& operation, const std::string& more = "") {
    const auto header = security(fmt::format("nonce{}", ++nonces), utime_us(), "ptz-camera");
    const auto answer = send(
        header, fmt::format("<{0}><ProfileToken>main</ProfileToken>{1}</{0}>", operation, more));
    return answer ? answer->body : "";
  }
  void drive(double x, double y, const std::string& timeout) {
    const auto vector = fmt::format(R"(<Velocity><tt:PanTilt x="{}" y="{}"/></Velocity>)", x, y);
    EXPECT_THAT(ask("ContinuousMove", vector + "<Timeout>" + timeout + "</Timeout>"),
                HasSubstr("ContinuousMoveResponse"));
  }
  void go_to(double x, double y) {
    EXPECT_THAT(ask("AbsoluteMove",
                    fmt::format(R"(<Position><tt:PanTilt x="{}" y="{}"/></Position>)", x, y)),
                HasSubstr("AbsoluteMoveResponse"));
  }
  void set_fault(const std::function<void(PtzFaults&)>& set) {
    PtzFaults faults;
    set(faults);
    device.set_faults(faults, now_s);
  }
  double pan_deg() const { return degrees(device.angles_at(now_s).pan_rad); }
  double tilt_deg() const { return degrees(device.angles_at(now_s).tilt_rad); }
  // Of x, in degrees of pan; NaN: none.
  double reported_pan_deg() {
    const std::string text = ask("GetStatus");
    const auto at = text.find("x=\"");
    return at == std::string::npos ? std::nan("") : -170.0 * std::stod(text.substr(at + 3));
  }

  double now_s = 100.0;
  int nonces = 0;
  OnvifDevice device{config(), 1, now_s};
};

TEST(OnvifDevice, MovesAsItIsTold) {
  Camera camera;
  camera.drive(0.5, 0.25, "PT2S");  // to the right, up
  camera.now_s += 1.0;
  EXPECT_NEAR(camera.pan_deg(), -(30.0 * 1.0 - 0.5 * 30.0 * 0.25), 0.01);
  EXPECT_THAT(camera.ask("GetStatus"), HasSubstr("MOVING"));
  camera.now_s += 9.0;
  EXPECT_NEAR(camera.pan_deg(), -60.0, 0.01) << "the time-out ends it";
  EXPECT_NEAR(camera.tilt_deg(), 30.0, 0.01);
  EXPECT_THAT(camera.ask("GetStatus"), HasSubstr("IDLE"));
  EXPECT_NEAR(camera.reported_pan_deg(), -60.0, 0.01);

  camera.go_to(0.1, -0.5);
  camera.now_s += 5.0;
  EXPECT_NEAR(camera.pan_deg(), -17.0, 1e-3);
  EXPECT_NEAR(camera.tilt_deg(), 0.0, 1e-3);
  camera.ask("RelativeMove", R"(<Translation><tt:PanTilt x="-0.2" y="0"/></Translation>)");
  camera.now_s += 5.0;
  EXPECT_NEAR(camera.pan_deg(), 17.0, 1e-3);

  camera.drive(1.0, 0.0, "PT60S");
  camera.now_s += 1.0;
  EXPECT_THAT(camera.ask("Stop"), HasSubstr("StopResponse"));
  camera.now_s += 10.0;
  EXPECT_NEAR(camera.pan_deg(), 17.0 - 60.0, 0.01) << "it brakes as it has accelerated";
  camera.drive(-1.0, 0.0, "PT60S");
  camera.now_s += 20.0;
  EXPECT_NEAR(camera.pan_deg(), 170.0, 1e-3) << "the end of its travel";
}

TEST(OnvifDevice, RefusesInTheWordsOfTheStandard) {
  const struct {
    const char *operation, *more, *subcode;
  } cases[] = {
      {"AbsoluteMove", R"(<Position><tt:PanTilt x="1.1" y="0"/></Position>)", "InvalidPosition"},
      {"AbsoluteMove", R"(<Position><tt:PanTilt x="nan" y="0"/></Position>)", "InvalidPosition"},
      {"AbsoluteMove", "", "InvalidArgs"},
      {"AbsoluteMove", R"(<Position><tt:PanTilt x="0" y="0" space="http://a"/></Position>)",
       "SpaceNotSupported"},
      {"ContinuousMove", R"(<Velocity><tt:PanTilt x="2" y="0"/></Velocity>)", "InvalidVelocity"},
      {"ContinuousMove", R"(<Velocity><tt:PanTilt x="1" y="0"/></Velocity><Timeout>PT2H</Timeout>)",
       "TimeoutNotSupported"},
      {"ContinuousMove", R"(<Velocity><tt:PanTilt x="1" y="0"/></Velocity><Timeout>1</Timeout>)",
       "TimeoutNotSupported"},
      {"GotoPreset", "", "ActionNotSupported"},
      {"GetNode", "<NodeToken>other</NodeToken>", "NoEntity"},
  };
  for (const auto& one : cases) {
    Camera camera;
    EXPECT_THAT(camera.ask(one.operation, one.more), HasSubstr("ter:" + std::string(one.subcode)));
    camera.now_s += 2.0;
    EXPECT_EQ(camera.pan_deg(), 0.0) << one.more;
  }
  Camera camera;
  EXPECT_EQ(camera.device.answer({"POST", "/", "", "<a>"}, camera.now_s, 0)->status, 400);
  EXPECT_THAT(camera.device.answer({"POST", "/", "", "<a/>"}, camera.now_s, 0)->body,
              HasSubstr("VersionMismatch"));
}

TEST(OnvifDevice, LetsOnlyTheOwnerIn) {
  Camera camera;
  const std::string request = "<GetStatus><ProfileToken>main</ProfileToken></GetStatus>";
  const auto status = [&](const std::string& header) {
    return camera.send(header, request)->status;
  };
  const auto now_us = camera.utime_us();
  EXPECT_EQ(status(security("a", now_us, "ptz-camera")), 200);
  EXPECT_EQ(status(security("a", now_us, "ptz-camera")), 400) << "the same nonce again";
  EXPECT_EQ(status(security("b", now_us, "wrong")), 400);
  EXPECT_EQ(status(security("c", now_us - 6'000'000, "ptz-camera")), 400) << "old";
  const auto asked = camera.send("", request);
  EXPECT_EQ(asked->status, 401);
  EXPECT_THAT(asked->challenge, HasSubstr("Digest realm="));
  EXPECT_THAT(asked->body, HasSubstr("ter:NotAuthorized"));
  const auto probe = camera.device.answer({"POST", "/onvif/ptz_service", "", ""}, 100.0, now_us);
  EXPECT_EQ(probe->status, 401);
  EXPECT_THAT(probe->challenge, HasSubstr("nonce="));
  // RFC 7616 with this nonce is in tests/e2e/test_onvif.py.
  camera.set_fault([](PtzFaults& f) { f.clock_off_s = 3600.0; });
  EXPECT_EQ(status(security("d", now_us, "ptz-camera")), 400);
  EXPECT_EQ(status(security("e", now_us + 3'600'000'000, "ptz-camera")), 200) << "by its clock";
}

TEST(OnvifDevice, HasTheFaultsOfRealCameras) {
  const auto moving = [](const std::function<void(PtzFaults&)>& set) {
    auto camera = std::make_unique<Camera>();
    camera->set_fault(set);
    camera->drive(-1.0, 0.0, "PT1S");
    camera->now_s += 1.0;
    return camera;
  };
  const double true_deg = 60.0 * 0.75;  // a second after the start
  auto late = moving([](PtzFaults& f) { f.late_s = 0.5; });
  EXPECT_NEAR(late->pan_deg(), true_deg, 0.01);
  EXPECT_NEAR(late->reported_pan_deg(), 15.0, 0.01);
  EXPECT_NEAR(moving([](PtzFaults& f) { f.step_deg = 10.0; })->reported_pan_deg(), 50.0, 0.01);
  EXPECT_NEAR(moving([](PtzFaults& f) { f.frozen = true; })->reported_pan_deg(), 0.0, 0.01);
  auto silent = moving([](PtzFaults& f) { f.no_position = true; });
  EXPECT_THAT(silent->ask("GetStatus"), Not(HasSubstr("Position>")));
  EXPECT_THAT(silent->ask("GetStatus"), HasSubstr("UtcTime"));

  auto endless = moving([](PtzFaults& f) { f.ignores_timeout = true; });
  endless->now_s += 1.0;
  EXPECT_NEAR(endless->pan_deg(), true_deg + 60.0, 0.01);
  endless->ask("Stop");
  endless->now_s += 5.0;
  EXPECT_NEAR(endless->pan_deg(), 120.0, 0.01);

  auto deaf = moving([](PtzFaults& f) { f.ignores_stop = true; });
  deaf->ask("Stop");
  deaf->now_s += 5.0;
  EXPECT_NEAR(deaf->pan_deg(), 60.0, 0.01) << "its time-out still ends it";

  Camera cut;
  cut.set_fault([](PtzFaults& f) { f.lost_share = 0.5; });
  int lost = 0;
  for (int i = 0; i < 100; ++i) lost += cut.ask("GetStatus").empty() ? 1 : 0;
  EXPECT_GT(lost, 25);
  EXPECT_LT(lost, 75);

  auto fresh = moving([](PtzFaults&) {});
  fresh->set_fault([](PtzFaults& f) { f.reboots = true; });
  fresh->now_s += 19.0;
  EXPECT_EQ(fresh->ask("GetStatus"), "");
  EXPECT_NEAR(fresh->pan_deg(), 0.0, 1e-9) << "home";
  fresh->now_s += 1.1;
  EXPECT_NEAR(fresh->reported_pan_deg(), 0.0, 1e-9);
}

// How a move misses its place, a client sees only in the picture. It stays until the next move to a
// place.
TEST(PtzUnit, ReportsNotByHowMuchItMissed) {
  PtzUnit unit({.repeatability_rad = radians(0.2)}, 3, 0.0);
  unit.go_to(PtzUnit::kPan, radians(10.0), radians(60.0), 0.0);
  EXPECT_NEAR(unit.reported(2.0)->pan_rad, radians(10.0), 1e-9);
  const double missed_rad = unit.angles_at(2.0).pan_rad - radians(10.0);
  EXPECT_GT(std::abs(missed_rad), radians(0.01));
  unit.drive(PtzUnit::kPan, radians(5.0), 1.0, 2.0);
  EXPECT_NEAR(unit.angles_at(3.0).pan_rad - unit.reported(3.0)->pan_rad, missed_rad, 1e-9);
  unit.go_to(PtzUnit::kPan, 0.0, radians(60.0), 4.0);
  EXPECT_GT(std::abs(unit.angles_at(6.0).pan_rad - missed_rad), radians(0.01));
}

}  // namespace
}  // namespace ols::sim
