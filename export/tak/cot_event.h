// Cursor on Target: one event with the fields that its two encodings, XML and protobuf, share
// (MITRE, "Cursor on Target Message Router User's Guide"; the event schema 2.0). Pure.
//
// `ce` and `le` are what the schema calls one sigma of the error: ce the larger semi-axis of the
// horizontal ellipse, le that of the height. The whole covariance stands in <_ols_> of the detail.
#pragma once

#include <cstdint>
#include <string>

#include "export/records.h"

namespace ols::exports {

struct CotSettings {
  std::string target_type = "a-u-A";       // an unknown in the air
  std::string station_type = "a-f-G-E-S";  // a friendly sensor on the ground
  double stale_s = 10.0;                   // after which a client fades it
  double line_m = 5000.0;                  // how far a line is drawn
};

struct CotEvent {
  std::string type, uid, how, callsign;
  std::int64_t utime_us = 0, stale_us = 0;
  Place point;
  double ce_m = kUnknown, le_m = kUnknown;
  double speed_m_s = kUnknown, course_deg = kUnknown;
  std::string geopoint_source;  // of <precisionlocation>: where the position comes from
  std::string detail;           // XML of what has no field of its own
};

// What stands for "not known" in ce and le.
inline constexpr double kCotUnknown_m = 9999999.0;

// A target that has ended is stale at once.
CotEvent cot_event(const Target& target, const CotSettings& settings);
CotEvent cot_event(const Station& station, const CotSettings& settings);
// A line is a range-and-bearing line from its camera.
CotEvent cot_event(const Line& line, const CotSettings& settings);

}  // namespace ols::exports
