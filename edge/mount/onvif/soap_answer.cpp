#include "edge/mount/onvif/soap_answer.h"

#include <charconv>
#include <cmath>
#include <ctime>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include "edge/mount/onvif/soap_xml.h"

namespace ols::onvif {
namespace {

using Node = pugi::xml_node;
using namespace soap_xml;

constexpr double kGreatest = 1e5;  // of any number: degrees, spaces, seconds
constexpr std::size_t kLongestToken = 200, kLongestAddress = 2000, kMostProfiles = 64;

// An answer in its envelope.
class Answer {
 public:
  Answer(const std::string& text, std::string request) : request_(std::move(request)) {
    if (!document_.load_buffer(text.data(), text.size())) throw wrong("no XML");
    const Node body = child(child(document_, "Envelope"), "Body");
    if (!body) throw wrong("no SOAP envelope");
    if (const Node fault = child(body, "Fault")) throw soap_fault(fault);
    response_ = child(body, request_ + "Response");
    if (!response_) throw wrong("another answer");
  }
  const Node& response() const { return response_; }

  AnswerError wrong(const std::string& what) const { return AnswerError(request_ + ": " + what); }

  Node required(const Node& parent, const std::string& name) const {
    const Node node = child(parent, name);
    if (!node) throw wrong("no " + name);
    return node;
  }

  double number(const std::string& text, const std::string& name) const {
    double value = 0.0;
    const std::string digits = trimmed(text);
    const char* end = digits.data() + digits.size();
    const auto [stopped, error] = std::from_chars(digits.data(), end, value);
    if (error != std::errc() || stopped != end || !std::isfinite(value))
      throw wrong(name + " is no number: " + words(text));
    if (std::abs(value) > kGreatest) throw wrong(name + " is absurd: " + words(text));
    return value;
  }

  double attribute(const Node& node, const char* name) const {
    const auto value = node.attribute(name);
    if (!value) throw wrong(std::string(local(node.name())) + " without " + name);
    return number(value.value(), std::string(local(node.name())) + " " + name);
  }

  // A limit that is no number, such as INF, is refused like a missing one.
  Span span(const Node& node) const {
    const Span span{number(text_of(required(node, "Min")), "Min"),
                    number(text_of(required(node, "Max")), "Max")};
    if (!(span.min < span.max))
      throw wrong(std::string(local(node.name())) + " with Min not below Max");
    return span;
  }

  Space space(const Node& node) const {
    return {span(required(node, "XRange")), span(required(node, "YRange"))};
  }

  std::string token(const Node& node) const {
    const std::string token = node.attribute("token").value();
    if (token.empty() || token.size() > kLongestToken)
      throw wrong(std::string(local(node.name())) + " without a usable token");
    return token;
  }

 private:
  SoapFault soap_fault(const Node& fault) const {
    const Node code = child(fault, "Code");
    std::string codes = code ? text_of(child(code, "Value")) : text_of(child(fault, "faultcode"));
    for (Node inner = child(code, "Subcode"); inner; inner = child(inner, "Subcode"))
      codes += " " + text_of(child(inner, "Value"));
    std::string reason = text_of(child(child(fault, "Reason"), "Text"));
    if (reason.empty()) reason = text_of(child(fault, "faultstring"));
    bool login = false;
    for (const char* word : {"NotAuthorized", "FailedAuthentication", "InvalidSecurityToken"})
      login = login || codes.find(word) != std::string::npos;
    if (reason.empty()) reason = codes;
    return {request_ + " refused: " + words(reason), login};
  }

  std::string request_;
  pugi::xml_document document_;
  Node response_;
};

std::optional<Space> first_space(const Answer& answer, const Node& spaces, const char* name) {
  const Node node = child(spaces, name);
  if (!node) return std::nullopt;
  return answer.space(node);
}

// "PT1M0.5S"; no motion takes days.
std::optional<double> seconds(std::string_view text) {
  if (!text.starts_with("PT")) return std::nullopt;
  double sum = 0.0;
  for (text.remove_prefix(2); !text.empty();) {
    double value = 0.0;
    const auto [stopped, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stopped == text.data() + text.size()) return std::nullopt;
    const char unit = *stopped;
    if (unit != 'H' && unit != 'M' && unit != 'S') return std::nullopt;
    sum += value * (unit == 'H' ? 3600.0 : unit == 'M' ? 60.0 : 1.0);
    text.remove_prefix(static_cast<std::size_t>(stopped - text.data()) + 1);
  }
  return std::isfinite(sum) && sum >= 0.0 ? std::optional(sum) : std::nullopt;
}

std::optional<Span> timeouts(const Node& options) {
  const Node node = child(options, "PTZTimeout");
  const auto min = seconds(text_of(child(node, "Min"))), max = seconds(text_of(child(node, "Max")));
  if (!min || !max || !(*min < *max)) return std::nullopt;
  return Span{*min, *max};
}

}  // namespace

std::optional<std::int64_t> date_and_time(const std::string& text) {
  const Answer answer(text, "GetSystemDateAndTime");
  const Node utc = below(answer.response(), "UTCDateTime");
  if (!utc) return std::nullopt;
  const Node date = answer.required(utc, "Date"), time = answer.required(utc, "Time");
  const auto field = [&](const Node& of, const char* name, int min, int max) {
    const double value = answer.number(text_of(answer.required(of, name)), name);
    if (value < min || value > max || value != std::floor(value))
      throw answer.wrong(std::string(name) + " is absurd");
    return static_cast<int>(value);
  };
  std::tm parts{};
  parts.tm_year = field(date, "Year", 1970, 9999) - 1900;
  parts.tm_mon = field(date, "Month", 1, 12) - 1;
  parts.tm_mday = field(date, "Day", 1, 31);
  parts.tm_hour = field(time, "Hour", 0, 23);
  parts.tm_min = field(time, "Minute", 0, 59);
  parts.tm_sec = field(time, "Second", 0, 60);
  return timegm(&parts);
}

DeviceInformation device_information(const std::string& text) {
  const Answer answer(text, "GetDeviceInformation");
  return {words(text_of(child(answer.response(), "Manufacturer")) + " " +
                text_of(child(answer.response(), "Model"))),
          words(trimmed(text_of(child(answer.response(), "SerialNumber"))))};
}

Services services(const std::string& text) {
  const Answer answer(text, "GetCapabilities");
  const Node all = answer.required(answer.response(), "Capabilities");
  return {text_of(child(child(all, "Media"), "XAddr")), text_of(child(child(all, "PTZ"), "XAddr"))};
}

Services listed_services(const std::string& text) {
  const Answer answer(text, "GetServices");
  Services services;
  for (const Node& node : answer.response().children()) {
    const std::string space = text_of(child(node, "Namespace"));
    for (const auto& [of, address] :
         {std::pair{"http://www.onvif.org/ver10/media/wsdl", &services.media},
          {"http://www.onvif.org/ver20/media/wsdl", &services.media2},
          {"http://www.onvif.org/ver20/ptz/wsdl", &services.ptz}}) {
      if (space == of) *address = text_of(child(node, "XAddr"));
    }
  }
  return services;
}

namespace {

// `ptz`, `video`: the profile's configurations.
Profile profile(const Answer& answer, const Node& node, const Node& ptz, const Node& video) {
  Profile profile;
  profile.token = answer.token(node);
  if (ptz) profile.configuration = answer.token(ptz);
  profile.node = text_of(child(ptz, "NodeToken"));
  if (profile.node.size() > kLongestToken) profile.node.clear();
  profile.encoding = words(text_of(child(video, "Encoding")));
  const auto stated = [&](const Node& parent, const char* name) {
    const std::string text = text_of(child(parent, name));
    return text.empty() ? 0.0 : answer.number(text, name);
  };
  const Node size = child(video, "Resolution");
  profile.width_px = static_cast<int>(stated(size, "Width"));
  profile.height_px = static_cast<int>(stated(size, "Height"));
  profile.frame_rate_hz = stated(child(video, "RateControl"), "FrameRateLimit");
  return profile;
}

// `read`: reads the profile in a node.
std::vector<Profile> profiles_in(const std::string& text,
                                 Profile (*read)(const Answer& answer, const Node& node)) {
  const Answer answer(text, "GetProfiles");
  std::vector<Profile> profiles;
  for (const Node& node : answer.response().children()) {
    if (local(node.name()) != "Profiles") continue;
    if (profiles.size() == kMostProfiles) throw answer.wrong("too many profiles");
    profiles.push_back(read(answer, node));
  }
  return profiles;
}

std::string uri_in(const Answer& answer, const Node& parent) {
  const std::string uri = text_of(answer.required(parent, "Uri"));
  if (uri.empty() || uri.size() > kLongestAddress) throw answer.wrong("no usable Uri");
  return uri;
}

}  // namespace

std::vector<Profile> profiles(const std::string& text) {
  return profiles_in(text, [](const Answer& answer, const Node& node) {
    return profile(answer, node, child(node, "PTZConfiguration"),
                   child(node, "VideoEncoderConfiguration"));
  });
}

std::string stream_uri(const std::string& text) {
  const Answer answer(text, "GetStreamUri");
  return uri_in(answer, answer.required(answer.response(), "MediaUri"));
}

std::vector<Profile> media2_profiles(const std::string& text) {
  return profiles_in(text, [](const Answer& answer, const Node& node) {
    const Node all = child(node, "Configurations");
    Profile stated = profile(answer, node, child(all, "PTZ"), child(all, "VideoEncoder"));
    stated.of_media2 = true;
    return stated;
  });
}

std::string media2_stream_uri(const std::string& text) {
  const Answer answer(text, "GetStreamUri");
  return uri_in(answer, answer.response());
}

namespace {

PtzOptions moves(const Answer& answer, const Node& spaces) {
  PtzOptions result{{first_space(answer, spaces, "AbsolutePanTiltPositionSpace"),
                     first_space(answer, spaces, "ContinuousPanTiltVelocitySpace")},
                    first_space(answer, spaces, "RelativePanTiltTranslationSpace"),
                    {},
                    {}};
  if (const Node zoom = child(spaces, "AbsoluteZoomPositionSpace"))
    result.zoom = answer.span(answer.required(zoom, "XRange"));
  return result;
}

}  // namespace

PtzOptions options(const std::string& text) {
  const Answer answer(text, "GetConfigurationOptions");
  const Node options = answer.required(answer.response(), "PTZConfigurationOptions");
  PtzOptions result = moves(answer, answer.required(options, "Spaces"));
  result.timeout = timeouts(options);
  if (result.timeout) result.least_lease_s = result.timeout->min;
  return result;
}

PtzOptions node_options(const std::string& text) {
  const Answer answer(text, "GetNode");
  const Node node = answer.required(answer.response(), "PTZNode");
  return moves(answer, answer.required(node, "SupportedPTZSpaces"));
}

PtzStatus status(const std::string& text) {
  const Answer answer(text, "GetStatus");
  const Node status = answer.required(answer.response(), "PTZStatus");
  const Node position = answer.required(status, "Position");
  const Node pan_tilt = answer.required(position, "PanTilt");
  PtzStatus result{{answer.attribute(pan_tilt, "x"), answer.attribute(pan_tilt, "y")}, {}, {}};
  if (const Node zoom = child(position, "Zoom")) {
    result.zoom = answer.attribute(zoom, "x");
    if (*result.zoom < 0.0) throw answer.wrong("Zoom is negative");
  }
  const std::string moves = text_of(child(child(status, "MoveStatus"), "PanTilt"));
  if (moves == "MOVING" || moves == "IDLE") result.moving = moves == "MOVING";
  return result;
}

void check_done(const std::string& text, const std::string& request) {
  const Answer answer(text, request);
}

}  // namespace ols::onvif
