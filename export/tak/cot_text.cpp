#include "export/tak/cot_text.h"

#include <cmath>
#include <cstdint>

#include "export/text.h"
#include "export/uncertainty.h"
#include "tak/tak.pb.h"

namespace ols::exports {
namespace {

constexpr const char* kDeclaration =
    "<?xml version=\"1.0\" encoding=\"UTF-8\" standalone=\"yes\"?>\n";
constexpr char kMagic = '\xbf';

double or_unknown(double value_m) { return std::isfinite(value_m) ? value_m : kCotUnknown_m; }

std::string point_of(const CotEvent& event) {
  std::string text("<point lat=\"");
  text.append(fixed(event.point.latitude_deg, 8)).append("\" lon=\"");
  text.append(fixed(event.point.longitude_deg, 8)).append("\" hae=\"");
  text.append(fixed(event.point.height_m, 2)).append("\" ce=\"");
  text.append(fixed(rounded_up(or_unknown(event.ce_m), 2), 2)).append("\" le=\"");
  return text.append(fixed(rounded_up(or_unknown(event.le_m), 2), 2)).append("\"/>");
}

std::string detail_of(const CotEvent& event) {
  std::string text("<detail><contact callsign=\"");
  text.append(xml(event.callsign)).append("\"/>");
  text.append("<precisionlocation geopointsrc=\"").append(event.geopoint_source);
  text.append("\" altsrc=\"").append(event.geopoint_source).append("\"/>");
  if (std::isfinite(event.speed_m_s)) {
    text.append("<track speed=\"").append(fixed(event.speed_m_s, 2)).append("\" course=\"");
    text.append(fixed(event.course_deg, 1)).append("\"/>");
  }
  return text.append(event.detail).append("</detail>");
}

void append_varint(std::string& bytes, std::uint64_t value) {
  for (; value >= 0x80U; value >>= 7U) bytes += static_cast<char>((value & 0x7FU) | 0x80U);
  bytes += static_cast<char>(value);
}

tak::TakMessage message_of(const CotEvent& event) {
  tak::TakMessage message;
  tak::CotEvent& cot = *message.mutable_cotevent();
  cot.set_type(event.type);
  cot.set_uid(event.uid);
  cot.set_how(event.how);
  cot.set_sendtime(static_cast<std::uint64_t>(event.utime_us / 1000));
  cot.set_starttime(static_cast<std::uint64_t>(event.utime_us / 1000));
  cot.set_staletime(static_cast<std::uint64_t>(event.stale_us / 1000));
  cot.set_lat(event.point.latitude_deg);
  cot.set_lon(event.point.longitude_deg);
  cot.set_hae(event.point.height_m);
  cot.set_ce(or_unknown(event.ce_m));
  cot.set_le(or_unknown(event.le_m));
  tak::Detail& detail = *cot.mutable_detail();
  detail.set_xmldetail(event.detail);
  detail.mutable_contact()->set_callsign(event.callsign);
  detail.mutable_precisionlocation()->set_geopointsrc(event.geopoint_source);
  detail.mutable_precisionlocation()->set_altsrc(event.geopoint_source);
  if (std::isfinite(event.speed_m_s)) {
    detail.mutable_track()->set_speed(event.speed_m_s);
    detail.mutable_track()->set_course(event.course_deg);
  }
  return message;
}

}  // namespace

std::string cot_xml(const CotEvent& event) { return kDeclaration + cot_element(event); }

std::string cot_element(const CotEvent& event) {
  std::string text("<event version=\"2.0\" type=\"");
  text.append(xml(event.type)).append("\" uid=\"");
  text.append(xml(event.uid)).append("\" how=\"").append(event.how).append("\" time=\"");
  text.append(iso_time(event.utime_us)).append("\" start=\"").append(iso_time(event.utime_us));
  text.append("\" stale=\"").append(iso_time(event.stale_us)).append("\">");
  return text.append(point_of(event)).append(detail_of(event)).append("</event>");
}

std::string cot_document(const std::string& elements) {
  return std::string(kDeclaration) + "<events>\n" + elements + "</events>\n";
}

std::string cot_protobuf(const CotEvent& event, TakFraming framing) {
  const std::string content = message_of(event).SerializeAsString();
  std::string bytes(1, kMagic);
  if (framing == TakFraming::kMesh) {
    bytes.append("\x01").append(1, kMagic);
  } else {
    append_varint(bytes, content.size());
  }
  return bytes.append(content);
}

}  // namespace ols::exports
