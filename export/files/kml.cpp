#include "export/files/kml.h"

#include "export/text.h"
#include "export/uncertainty.h"

namespace ols::exports {
namespace {

constexpr const char* kHead =
    "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
    "<kml xmlns=\"http://www.opengis.net/kml/2.2\" "
    "xmlns:gx=\"http://www.google.com/kml/ext/2.2\">\n";

std::string coordinates(const Place& place, const char* separator) {
  std::string text = fixed(place.longitude_deg, 8);
  text.append(separator).append(fixed(place.latitude_deg, 8)).append(separator);
  return text.append(fixed(place.above_sea_m(), 2));
}

std::string data(const char* name, const std::string& value) {
  if (value.empty()) return {};
  std::string text("<Data name=\"");
  return text.append(name).append("\"><value>").append(xml(value)).append("</value></Data>");
}

std::string begin_placemark(const std::string& uid, const std::string& name, const char* style) {
  std::string text("<Placemark id=\"");
  text.append(xml(uid)).append("\"><name>").append(xml(name)).append("</name><styleUrl>#");
  return text.append(style).append("</styleUrl>");
}

std::string target_data(const Target& target) {
  const Ellipse ellipse = ellipse_of(target.covariance_m2);
  const Motion motion = motion_of(target);
  return "<ExtendedData>" + data("state", to_string(target.state)) +
         data("time", iso_time(target.utime_us)) +
         data("height_ellipsoid_m", fixed(target.place.height_m, 2)) +
         data("ellipse_semi_major_m", fixed(rounded_up(ellipse.semi_major_m, 2), 2)) +
         data("ellipse_semi_minor_m", fixed(rounded_up(ellipse.semi_minor_m, 2), 2)) +
         data("ellipse_azimuth_deg", fixed(ellipse.azimuth_deg, 1)) +
         data("height_sd_m", fixed(rounded_up(sd(target.covariance_m2[5]), 2), 2)) +
         data("speed_m_s", fixed(motion.speed_m_s, 2)) +
         data("course_deg", fixed(motion.course_deg, 1)) + "</ExtendedData>";
}

void append_track(std::string& text, const std::string& uid, const Track& track) {
  text += begin_placemark(uid, callsign(track.last), "target");
  text += target_data(track.last);
  text += "<gx:Track><altitudeMode>absolute</altitudeMode>";
  for (const Target& point : track.points) {
    text.append("<when>").append(iso_time(point.utime_us)).append("</when>");
  }
  for (const Target& point : track.points) {
    text.append("<gx:coord>").append(coordinates(point.place, " ")).append("</gx:coord>");
  }
  text += "</gx:Track></Placemark>\n";
}

void append_station(std::string& text, const std::string& uid, const Station& station) {
  text += begin_placemark(uid, station.name, "station");
  text += "<ExtendedData>" + data("state", station.state) +
          data("alarms", std::to_string(station.alarms)) + "</ExtendedData>";
  text.append("<Point><altitudeMode>absolute</altitudeMode><coordinates>");
  text.append(coordinates(station.place, ",")).append("</coordinates></Point></Placemark>\n");
}

void append_line(std::string& text, const std::string& uid, const Line& line, double line_m) {
  text += begin_placemark(uid, line.station + " sees", "line");
  text.append("<LineString><altitudeMode>absolute</altitudeMode><coordinates>");
  text.append(coordinates(line.camera, ",")).append(" ");
  text.append(coordinates(end_of(line, line_m), ",")).append("</coordinates></LineString>");
  text.append("</Placemark>\n");
}

}  // namespace

std::string kml(const Picture& picture, double line_m) {
  std::string text = kHead;
  text +=
      "<Document><name>OLS</name>\n"
      "<Style id=\"target\"><LineStyle><color>ff0000ff</color><width>2</width></LineStyle></Style>"
      "<Style id=\"station\"><IconStyle><color>ffff9000</color></IconStyle></Style>"
      "<Style id=\"line\"><LineStyle><color>8000ffff</color></LineStyle></Style>\n";
  for (const auto& [uid, track] : picture.tracks()) {
    if (!track.points.empty()) append_track(text, uid, track);
  }
  for (const auto& [uid, station] : picture.stations()) append_station(text, uid, station);
  for (const auto& [uid, seen] : picture.lines()) {
    append_line(text, uid, seen.points.back(), line_m);
  }
  return text += "</Document></kml>\n";
}

std::string kml_link(const std::string& file, double interval_s) {
  std::string text = kHead;
  text.append("<NetworkLink><name>OLS</name><Link><href>").append(xml(file));
  text.append("</href><refreshMode>onInterval</refreshMode><refreshInterval>");
  return text.append(fixed(interval_s, 2))
      .append("</refreshInterval></Link></NetworkLink></kml>\n");
}

}  // namespace ols::exports
