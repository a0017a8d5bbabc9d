#include "sim/onvif/device.h"

#include <algorithm>
#include <cmath>

namespace ols::sim {
namespace {

constexpr const char* kSecurity =
    "http://docs.oasis-open.org/wss/2004/01/oasis-200401-wss-wssecurity-secext-1.0.xsd";
constexpr const char* kUtility =
    "http://docs.oasis-open.org/wss/2004/01/oasis-200401-wss-wssecurity-utility-1.0.xsd";

OnvifAnswer refused(const SoapFault& fault) { return {fault.http_status(), enveloped(fault), ""}; }

const SoapFault& not_authorized() {
  static const SoapFault fault{"Sender", {"NotAuthorized"}, "Sender not authorized"};
  return fault;
}

std::optional<UsernameToken> token_in(pugi::xml_node envelope) {
  const auto header = child_of(envelope, onvif_space::kEnvelope, "Header");
  const auto token = child_of(child_of(header, kSecurity, "Security"), kSecurity, "UsernameToken");
  if (!token) return std::nullopt;
  return UsernameToken{text_of(child_of(token, kSecurity, "Username")),
                       text_of(child_of(token, kSecurity, "Password")),
                       text_of(child_of(token, kSecurity, "Nonce")),
                       text_of(child_of(token, kUtility, "Created"))};
}

}  // namespace

OnvifDevice::OnvifDevice(const OnvifConfig& config, std::uint64_t seed, double time_s)
    : config_(config),
      login_(config.user, config.password, seed),
      unit_(config.unit, seed, time_s),
      random_(seed) {}

void OnvifDevice::set_faults(const PtzFaults& faults, double time_s) {
  faults_ = faults;
  unit_.set_faults(faults, time_s);
}

std::optional<OnvifAnswer> OnvifDevice::answer(const OnvifRequest& request, double time_s,
                                               std::int64_t utime_us) {
  time_s_ = time_s;
  utime_us_ = utime_us + std::llround(1e6 * faults_.clock_off_s);
  if (!unit_.answers(time_s) || std::bernoulli_distribution(faults_.lost_share)(random_)) {
    return std::nullopt;
  }
  // Some clients ask for the challenge of HTTP digest before they send what they want.
  if (request.body.empty()) {
    return OnvifAnswer{401, enveloped(not_authorized()), login_.challenge(false, time_s_)};
  }
  pugi::xml_document message;
  if (!message.load_buffer(request.body.data(), request.body.size()) ||
      !message.document_element()) {
    return refused({"Sender", {"WellFormed"}, "Well-formed Error"});
  }
  try {
    return answer(message, request);
  } catch (const SoapFault& fault) {
    return refused(fault);
  }
}

OnvifAnswer OnvifDevice::answer(const pugi::xml_document& message, const OnvifRequest& request) {
  const auto envelope = message.document_element();
  const XmlName root = name_of(envelope);
  if (root.local != "Envelope" || root.space != onvif_space::kEnvelope) {
    throw SoapFault{"VersionMismatch", {}, "Not an envelope of SOAP 1.2"};
  }
  const auto body = child_of(envelope, onvif_space::kEnvelope, "Body");
  const auto asked =
      body.find_child([](pugi::xml_node child) { return child.type() == pugi::node_element; });
  if (!asked) throw SoapFault{"Sender", {"WellFormed"}, "No request in the body"};
  const Operation* found = operation(name_of(asked));
  if (found == nullptr || !found->open) {
    if (auto no = refusal(envelope, request)) return *no;
  }
  if (found == nullptr) {
    throw SoapFault{"Receiver", {"ActionNotSupported"}, "Optional Action Not Implemented"};
  }
  return {200, enveloped((this->*found->run)(asked)), ""};
}

// A token that is given decides; HTTP digest is asked of those who give nothing.
std::optional<OnvifAnswer> OnvifDevice::refusal(pugi::xml_node envelope,
                                                const OnvifRequest& request) {
  if (const auto token = token_in(envelope)) {
    if (login_.accepts(*token, 1e-6 * static_cast<double>(utime_us_))) return std::nullopt;
    return refused(not_authorized());
  }
  const auto verdict =
      login_.accepts(request.authorization, request.method, request.target, time_s_);
  if (verdict == Login::Verdict::kGood) return std::nullopt;
  return OnvifAnswer{401, enveloped(not_authorized()),
                     login_.challenge(verdict == Login::Verdict::kStale, time_s_)};
}

const OnvifDevice::Operation* OnvifDevice::operation(const XmlName& name) {
  using namespace onvif_space;
  using D = OnvifDevice;
  static constexpr Operation kOperations[] = {
      {kDevice, "GetSystemDateAndTime", true, &D::date_and_time},
      {kDevice, "GetServices", true, &D::services},
      {kDevice, "GetCapabilities", true, &D::capabilities},
      {kDevice, "GetServiceCapabilities", true, &D::device_capabilities},
      {kDevice, "GetDeviceInformation", false, &D::device_information},
      {kDevice, "GetScopes", false, &D::scopes},
      {kMedia, "GetServiceCapabilities", false, &D::media_capabilities},
      {kMedia, "GetVideoSources", false, &D::video_sources},
      {kMedia, "GetProfiles", false, &D::profiles},
      {kMedia, "GetProfile", false, &D::profile},
      {kMedia, "GetStreamUri", false, &D::stream_uri},
      {kMedia2, "GetServiceCapabilities", false, &D::media2_capabilities},
      {kMedia2, "GetProfiles", false, &D::media2_profiles},
      {kMedia2, "GetStreamUri", false, &D::media2_stream_uri},
      {kPtz, "GetServiceCapabilities", false, &D::ptz_capabilities},
      {kPtz, "GetNodes", false, &D::nodes},
      {kPtz, "GetNode", false, &D::node},
      {kPtz, "GetConfigurations", false, &D::configurations},
      {kPtz, "GetConfiguration", false, &D::configuration},
      {kPtz, "GetConfigurationOptions", false, &D::configuration_options},
      {kPtz, "GetStatus", false, &D::status},
      {kPtz, "ContinuousMove", false, &D::continuous_move},
      {kPtz, "AbsoluteMove", false, &D::absolute_move},
      {kPtz, "RelativeMove", false, &D::relative_move},
      {kPtz, "Stop", false, &D::stop}};
  const auto* found = std::ranges::find_if(kOperations, [&name](const Operation& one) {
    return name.space == one.space && name.local == one.name;
  });
  return found == std::end(kOperations) ? nullptr : found;
}

}  // namespace ols::sim
