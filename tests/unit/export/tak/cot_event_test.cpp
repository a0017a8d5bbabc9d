#include "export/tak/cot_event.h"

#include <gmock/gmock.h>

#include <string>
#include <tuple>
#include <vector>

#include "tests/unit/export/made_records.h"

namespace ols::exports {
namespace {

using testing::HasSubstr;

TEST(CotEvent, OfATarget) {
  const CotEvent event = cot_event(made_target(), CotSettings{.stale_s = 7.5});
  EXPECT_EQ(event.type, "a-u-A");
  EXPECT_EQ(event.uid, "site.target.a.7");
  EXPECT_EQ(event.stale_us - event.utime_us, 7'500'000);
  EXPECT_DOUBLE_EQ(event.point.height_m, 100.0);
  EXPECT_NEAR(event.ce_m, 3.0319, 1e-4);  // of the variances 4 and 9 with the covariance 1
  EXPECT_DOUBLE_EQ(event.le_m, 5.0);
  EXPECT_DOUBLE_EQ(event.speed_m_s, 5.0);
  EXPECT_THAT(event.detail, HasSubstr("covariance_enu_m2=\"4.0000 1.0000 0.0000 9.0000"));
  EXPECT_THAT(event.detail, HasSubstr("stations=\"alfa bravo\""));
  EXPECT_THAT(event.detail, HasSubstr("height_above_ground_m=\"12.3\""));
}

TEST(CotEvent, ADroneHasATypeOfItsOwn) {
  Target target = made_target();
  target.class_probability = 0.875;
  using Class = ObjectClass;
  for (const auto& [object_class, setting, type, word] :
       std::vector<std::tuple<Class, const char*, const char*, const char*>>{
           {Class::kDrone, "a-u-A", "a-u-A-M-F-Q", "drone"},
           {Class::kDrone, "a-s-A", "a-s-A-M-F-Q", "drone"},
           {Class::kDrone, "a-u-G", "a-u-G", "drone"},
           {Class::kDrone, "a-h-A-M-H-Q", "a-h-A-M-H-Q", "drone"},
           {Class::kBird, "a-u-A", "a-u-A", "bird"},
           {Class::kUnknown, "a-u-A", "a-u-A", "unknown"}}) {
    target.object_class = object_class;
    const CotEvent event = cot_event(target, CotSettings{.target_type = setting});
    EXPECT_EQ(event.type, type);
    EXPECT_THAT(event.detail, HasSubstr(std::string(" class=\"") + word + "\" class_probability"));
  }
}

TEST(CotEvent, AnEndIsStaleAtOnce) {
  Target target = made_target();
  target.state = TrackState::kEnded;
  const CotEvent event = cot_event(target, {});
  EXPECT_EQ(event.stale_us, event.utime_us);
}

TEST(CotEvent, AnIncidentIsAnAlertUntilItIsOverOrDismissed) {
  Incident incident = made_incident();
  const CotEvent event = cot_event(incident, {});
  EXPECT_EQ(event.type, "b-a-g");
  EXPECT_EQ(event.callsign, "Gate <1>: drone OLS 7");
  EXPECT_THAT(event.detail,
              HasSubstr("<emergency type=\"Geo-fence Breached\">Gate &lt;1&gt;: drone OLS 7<"));
  EXPECT_THAT(event.detail, HasSubstr("<link relation=\"p-p\" type=\"a-u-A-M-F-Q\" "
                                      "uid=\"site.target.a.7\"/>"));
  incident.verdict = "confirmed";
  EXPECT_EQ(cot_event(incident, {}).type, "b-a-g");
  incident.verdict = "dismissed";
  const CotEvent end = cot_event(incident, {});
  EXPECT_EQ(end.type, "b-a-o-can");
  EXPECT_EQ(end.uid, event.uid);
  EXPECT_THAT(end.detail, HasSubstr("<emergency cancel=\"true\">"));
  incident.verdict = "open";
  incident.ended_us = kNow_us;
  EXPECT_EQ(cot_event(incident, {}).type, "b-a-o-can");
}

TEST(CotEvent, AStationHasItsCone) {
  const CotEvent event = cot_event(made_station(), {});
  EXPECT_THAT(
      event.detail,
      HasSubstr("<sensor azimuth=\"123.50\" elevation=\"4.25\" fov=\"2.00\" vfov=\"1.50\""));
  EXPECT_DOUBLE_EQ(event.ce_m, 0.75);
  Station unaimed = made_station();
  unaimed.azimuth_deg = kUnknown;
  EXPECT_EQ(cot_event(unaimed, {}).detail.find("<sensor"), std::string::npos);
}

TEST(CotEvent, ALineIsARangeAndBearingLine) {
  Line line = made_line();
  line.station = "a<b";
  const CotEvent event = cot_event(line, {});
  EXPECT_EQ(event.type, "u-rb-a");
  EXPECT_THAT(event.detail, HasSubstr("<bearing value=\"90.0000\"/>"));
  EXPECT_THAT(event.detail, HasSubstr("station=\"a&lt;b\""));
}

}  // namespace
}  // namespace ols::exports
