#include "cue/cot_reader.h"

#include <expat.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <string_view>

#include "cue/text_time.h"
#include "geometry/angles.h"
#include "tak/tak.pb.h"

namespace ols::cues {
namespace {

constexpr double kUnknown_m = 9999999.0;
constexpr std::string_view kMesh = "\xbf\x01\xbf";

// What both encodings say.
struct Event {
  std::string type, uid, callsign;
  std::int64_t utime_us = 0, stale_us = 0;
  double latitude_deg = NAN, longitude_deg = NAN, height_m = NAN, ce_m = NAN, le_m = NAN;
  double speed_m_s = NAN, course_deg = NAN;
  bool is_own = false;
};

using Attributes = std::map<std::string, std::string, std::less<>>;

// The elements that count, wherever they are in the event.
struct Elements {
  std::map<std::string, Attributes, std::less<>> first;
  XML_Parser parser = nullptr;
};

void take_element(void* user, const XML_Char* name, const XML_Char** attributes) {
  auto& elements = *static_cast<Elements*>(user);
  constexpr std::size_t kMost = 200;
  if (elements.first.size() >= kMost) return;
  const auto [place, is_new] = elements.first.try_emplace(name);
  for (; is_new && *attributes != nullptr; attributes += 2) {
    place->second.emplace(attributes[0], attributes[1]);
  }
}

// No event needs entities of its own.
void refuse_doctype(void* user, const XML_Char*, const XML_Char*, const XML_Char*, int) {
  XML_StopParser(static_cast<Elements*>(user)->parser, XML_FALSE);
}

std::string text(const Elements& elements, std::string_view element, std::string_view attribute) {
  const auto found = elements.first.find(element);
  if (found == elements.first.end()) return {};
  const auto value = found->second.find(attribute);
  return value == found->second.end() ? "" : value->second;
}

double number(const std::string& text) {
  double value = NAN;
  const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
  return bad == std::errc{} && end == text.data() + text.size() ? value : NAN;
}

std::optional<Event> event_of_xml(const std::string& message) {
  const std::unique_ptr<std::remove_pointer_t<XML_Parser>, void (*)(XML_Parser)> parser(
      XML_ParserCreate(nullptr), XML_ParserFree);
  Elements elements;
  elements.parser = parser.get();
  XML_SetUserData(parser.get(), &elements);
  XML_SetStartElementHandler(parser.get(), take_element);
  XML_SetStartDoctypeDeclHandler(parser.get(), refuse_doctype);
  const auto size = static_cast<int>(message.size());
  if (XML_Parse(parser.get(), message.data(), size, 1) != XML_STATUS_OK) return std::nullopt;
  const auto utime_us = utime_of_iso(text(elements, "event", "time"));
  const auto stale_us = utime_of_iso(text(elements, "event", "stale"));
  if (!utime_us || !stale_us || !elements.first.contains("point")) return std::nullopt;
  Event event;
  event.type = text(elements, "event", "type");
  event.uid = text(elements, "event", "uid");
  event.callsign = text(elements, "contact", "callsign");
  event.utime_us = *utime_us;
  event.stale_us = *stale_us;
  event.latitude_deg = number(text(elements, "point", "lat"));
  event.longitude_deg = number(text(elements, "point", "lon"));
  event.height_m = number(text(elements, "point", "hae"));
  event.ce_m = number(text(elements, "point", "ce"));
  event.le_m = number(text(elements, "point", "le"));
  event.speed_m_s = number(text(elements, "track", "speed"));
  event.course_deg = number(text(elements, "track", "course"));
  event.is_own = elements.first.contains("_ols_");
  return event;
}

std::optional<Event> event_of_protobuf(const std::string& message) {
  constexpr std::uint64_t kLast_ms = 253'402'300'799'999;  // of the year 9999
  exports::tak::TakMessage tak;
  if (!tak.ParseFromArray(message.data() + kMesh.size(),
                          static_cast<int>(message.size() - kMesh.size())) ||
      !tak.has_cotevent()) {
    return std::nullopt;
  }
  const exports::tak::CotEvent& cot = tak.cotevent();
  if (cot.sendtime() > kLast_ms || cot.staletime() > kLast_ms) return std::nullopt;
  Event event;
  event.type = cot.type();
  event.uid = cot.uid();
  event.utime_us = 1000 * static_cast<std::int64_t>(cot.sendtime());
  event.stale_us = 1000 * static_cast<std::int64_t>(cot.staletime());
  event.latitude_deg = cot.lat();
  event.longitude_deg = cot.lon();
  event.height_m = cot.hae();
  event.ce_m = cot.ce();
  event.le_m = cot.le();
  event.callsign = cot.detail().contact().callsign();
  if (cot.detail().has_track()) {
    event.speed_m_s = cot.detail().track().speed();
    event.course_deg = cot.detail().track().course();
  }
  event.is_own = cot.detail().xmldetail().find("<_ols_") != std::string::npos;
  return event;
}

std::optional<double> known_sd(double value_m) {
  const bool is_known = std::isfinite(value_m) && value_m > 0.0 && value_m < kUnknown_m;
  return is_known ? std::optional(value_m) : std::nullopt;
}

Report report_of(const Event& event) {
  Report report;
  report.name = event.uid;
  report.label = event.callsign;
  report.utime_us = event.utime_us;
  report.stale_us = event.stale_us;
  report.latitude_deg = event.latitude_deg;
  report.longitude_deg = event.longitude_deg;
  report.height_m = event.height_m;
  report.horizontal_sd_m = known_sd(event.ce_m);
  report.vertical_sd_m = known_sd(event.le_m);
  if (std::isfinite(event.speed_m_s) && std::isfinite(event.course_deg)) {
    const double course_rad = radians(event.course_deg);
    report.velocity_enu_m_s = {event.speed_m_s * std::sin(course_rad),
                               event.speed_m_s * std::cos(course_rad), 0.0};
  }
  return report;
}

}  // namespace

Reading cot_reading(const std::string& message, const CotTypes& types) {
  const bool is_protobuf = message.starts_with(kMesh);
  const auto event = is_protobuf ? event_of_protobuf(message) : event_of_xml(message);
  if (!event || event->uid.empty()) return Refused{Refusal::kMalformed, "no event"};
  if (event->is_own) return Refused{Refusal::kOwn, event->uid};
  const bool is_wanted = std::ranges::any_of(
      types, [&](const std::string& begin) { return event->type.starts_with(begin); });
  if (!is_wanted) return Refused{Refusal::kOtherType, event->uid};
  if (std::abs(event->height_m) >= kUnknown_m) return Refused{Refusal::kNoHeight, event->uid};
  return report_of(*event);
}

}  // namespace ols::cues
