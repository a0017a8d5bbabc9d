#include "export/files/gpx.h"

#include "export/text.h"

namespace ols::exports {
namespace {

// A track that was not seen for longer has a gap.
constexpr std::int64_t kGap_us = 5'000'000;

// What trkpt and wpt begin with, in the order that the schema demands.
std::string point(const Place& place, std::int64_t utime_us) {
  std::string text(" lat=\"");
  text.append(fixed(place.latitude_deg, 8)).append("\" lon=\"");
  text.append(fixed(place.longitude_deg, 8)).append("\"><ele>");
  text.append(fixed(place.above_sea_m(), 2)).append("</ele><time>");
  text.append(iso_time(utime_us)).append("</time><geoidheight>");
  return text.append(fixed(place.geoid_m, 2)).append("</geoidheight>");
}

void append_track(std::string& text, const std::string& uid, const Track& track) {
  text.append("<trk><name>").append(xml(callsign(track.last))).append("</name><desc>");
  text.append(xml(uid)).append("</desc><trkseg>");
  std::int64_t before_us = 0;
  for (const Target& target : track.points) {
    if (before_us != 0 && target.utime_us - before_us > kGap_us) text += "</trkseg><trkseg>";
    before_us = target.utime_us;
    text.append("<trkpt").append(point(target.place, target.utime_us)).append("</trkpt>\n");
  }
  text += "</trkseg></trk>\n";
}

}  // namespace

std::string gpx(const Picture& picture) {
  std::string text(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<gpx version=\"1.1\" creator=\"OLS\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n");
  for (const auto& [uid, station] : picture.stations()) {
    text.append("<wpt").append(point(station.place, station.utime_us));
    text.append("<name>").append(xml(station.name)).append("</name></wpt>\n");
  }
  for (const auto& [uid, track] : picture.tracks()) {
    if (!track.points.empty()) append_track(text, uid, track);
  }
  return text += "</gpx>\n";
}

}  // namespace ols::exports
