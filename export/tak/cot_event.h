// An event of Cursor on Target, with the fields that its two encodings (XML and protobuf) have in
// common. Sources: MITRE, "Cursor on Target Message Router User's Guide"; the event schema 2.0 with
// its CoTtypes.xml. Pure.
//
// `ce` and `le` are the schema's one-sigma errors: ce is the larger semi-axis of the horizontal
// ellipse, le the 1-sigma of the height. The whole covariance is in the element <_ols_> of the
// event's detail.
#pragma once

#include <cstdint>
#include <string>

#include "export/records.h"

namespace ols::exports {

struct CotSettings {
  std::string target_type = "a-u-A";       // an unknown object in the air; for a drone a-u-A-M-F-Q
  std::string station_type = "a-f-G-E-S";  // a friendly sensor on the ground
  double stale_s = 10.0;                   // clients show an event as outdated after this time
  double line_m = 5000.0;                  // length of a line of sight, as drawn
};

struct CotEvent {
  std::string type, uid, how, callsign;
  std::int64_t utime_us = 0, stale_us = 0;
  Place point;
  double ce_m = kUnknown, le_m = kUnknown;
  double speed_m_s = kUnknown, course_deg = kUnknown;
  std::string geopoint_source;  // for <precisionlocation>: the source of the position
  std::string detail;           // the data that have no field of their own, as XML
};

// The value for "unknown" in ce and le.
inline constexpr double kCotUnknown_m = 9999999.0;

// The event of a target that has ended is stale at once.
CotEvent cot_event(const Target& target, const CotSettings& settings);
CotEvent cot_event(const Station& station, const CotSettings& settings);
// An alert for a breached geo-fence, as ATAK sends and shows it. When the target has left or the
// incident was dismissed, the event cancels the alert.
CotEvent cot_event(const Incident& incident, const CotSettings& settings);
// A range-and-bearing line from the station's camera.
CotEvent cot_event(const Line& line, const CotSettings& settings);

}  // namespace ols::exports
