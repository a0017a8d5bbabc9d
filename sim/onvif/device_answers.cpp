// What the camera says of itself: device and media service.

#include <fmt/format.h>

#include <cmath>
#include <ctime>

#include "sim/onvif/device.h"
#include "sim/onvif/ptz_entities.h"

namespace ols::sim {
namespace {

std::string xaddr(const OnvifConfig& c, const char* service) {
  return fmt::format("http://{}:{}/onvif/{}", c.address, c.port, service);
}

// Throws for any token but that of the only profile.
void check_profile(pugi::xml_node request, const char* space) {
  if (text_of(child_of(request, space, "ProfileToken")) != ptz_entity::kProfile) {
    throw SoapFault{
        "Sender", {"InvalidArgVal", "NoProfile"}, "The requested profile token does not exist"};
  }
}

// The schema of Media knows no H.265: a camera that sends it has a profile without an encoder
// there.
std::string encoder_text(const OnvifConfig& c) {
  if (c.encoding != "H264") return {};
  return fmt::format(
      R"(<tt:VideoEncoderConfiguration token="encoder"><tt:Name>encoder</tt:Name>)"
      R"(<tt:UseCount>1</tt:UseCount><tt:Encoding>H264</tt:Encoding>)"
      R"(<tt:Resolution><tt:Width>{0}</tt:Width><tt:Height>{1}</tt:Height></tt:Resolution>)"
      R"(<tt:Quality>5</tt:Quality><tt:RateControl><tt:FrameRateLimit>{2}</tt:FrameRateLimit>)"
      R"(<tt:EncodingInterval>1</tt:EncodingInterval><tt:BitrateLimit>8000</tt:BitrateLimit>)"
      R"(</tt:RateControl><tt:H264><tt:GovLength>25</tt:GovLength>)"
      R"(<tt:H264Profile>Baseline</tt:H264Profile></tt:H264>)"
      R"(<tt:Multicast><tt:Address><tt:Type>IPv4</tt:Type>)"
      R"(<tt:IPv4Address>0.0.0.0</tt:IPv4Address></tt:Address><tt:Port>0</tt:Port>)"
      R"(<tt:TTL>0</tt:TTL><tt:AutoStart>false</tt:AutoStart></tt:Multicast>)"
      R"(<tt:SessionTimeout>PT60S</tt:SessionTimeout></tt:VideoEncoderConfiguration>)",
      c.width_px, c.height_px, std::lround(c.frame_rate_hz));
}

// `name`: of the element.
std::string source_text(const OnvifConfig& c, const char* name) {
  return fmt::format(R"(<{0} token="source"><tt:Name>source</tt:Name><tt:UseCount>1</tt:UseCount>)"
                     R"(<tt:SourceToken>sensor</tt:SourceToken>)"
                     R"(<tt:Bounds x="0" y="0" width="{1}" height="{2}"/></{0}>)",
                     name, c.width_px, c.height_px);
}

std::string profile_text(const OnvifConfig& c, const char* element) {
  return fmt::format(
      R"(<trt:{0} token="{1}" fixed="true"><tt:Name>{1}</tt:Name>{2}{3}{4}</trt:{0}>)", element,
      ptz_entity::kProfile, source_text(c, "tt:VideoSourceConfiguration"), encoder_text(c),
      ptz_entity::configuration("tt:PTZConfiguration"));
}

}  // namespace

std::string OnvifDevice::date_and_time(pugi::xml_node) {
  const std::time_t utc_s = utime_us_ / 1'000'000;
  std::tm at{};
  gmtime_r(&utc_s, &at);
  return fmt::format(
      "<tds:GetSystemDateAndTimeResponse><tds:SystemDateAndTime>"
      "<tt:DateTimeType>NTP</tt:DateTimeType><tt:DaylightSavings>false</tt:DaylightSavings>"
      "<tt:TimeZone><tt:TZ>UTC0</tt:TZ></tt:TimeZone><tt:UTCDateTime>"
      "<tt:Time><tt:Hour>{}</tt:Hour><tt:Minute>{}</tt:Minute><tt:Second>{}</tt:Second></tt:Time>"
      "<tt:Date><tt:Year>{}</tt:Year><tt:Month>{}</tt:Month><tt:Day>{}</tt:Day></tt:Date>"
      "</tt:UTCDateTime></tds:SystemDateAndTime></tds:GetSystemDateAndTimeResponse>",
      at.tm_hour, at.tm_min, at.tm_sec, at.tm_year + 1900, at.tm_mon + 1, at.tm_mday);
}

std::string OnvifDevice::services(pugi::xml_node) {
  std::string all;
  for (const auto& [space, path] : {std::pair{onvif_space::kDevice, "device_service"},
                                    {onvif_space::kMedia, "media_service"},
                                    {onvif_space::kMedia2, "media2_service"},
                                    {onvif_space::kPtz, "ptz_service"}}) {
    all += fmt::format(
        "<tds:Service><tds:Namespace>{}</tds:Namespace><tds:XAddr>{}</tds:XAddr><tds:Version>"
        "<tt:Major>2</tt:Major><tt:Minor>60</tt:Minor></tds:Version></tds:Service>",
        space, xaddr(config_, path));
  }
  return fmt::format("<tds:GetServicesResponse>{}</tds:GetServicesResponse>", all);
}

std::string OnvifDevice::capabilities(pugi::xml_node) {
  return fmt::format(
      "<tds:GetCapabilitiesResponse><tds:Capabilities>"
      "<tt:Device><tt:XAddr>{}</tt:XAddr></tt:Device>"
      "<tt:Media><tt:XAddr>{}</tt:XAddr><tt:StreamingCapabilities>"
      "<tt:RTPMulticast>false</tt:RTPMulticast><tt:RTP_TCP>true</tt:RTP_TCP>"
      "<tt:RTP_RTSP_TCP>true</tt:RTP_RTSP_TCP></tt:StreamingCapabilities></tt:Media>"
      "<tt:PTZ><tt:XAddr>{}</tt:XAddr></tt:PTZ>"
      "</tds:Capabilities></tds:GetCapabilitiesResponse>",
      xaddr(config_, "device_service"), xaddr(config_, "media_service"),
      xaddr(config_, "ptz_service"));
}

std::string OnvifDevice::device_capabilities(pugi::xml_node) {
  return R"(<tds:GetServiceCapabilitiesResponse><tds:Capabilities><tds:Network/>)"
         R"(<tds:Security UsernameToken="true" HttpDigest="true" MaxUsers="1"/><tds:System/>)"
         R"(</tds:Capabilities></tds:GetServiceCapabilitiesResponse>)";
}

std::string OnvifDevice::device_information(pugi::xml_node) {
  return fmt::format(
      "<tds:GetDeviceInformationResponse><tds:Manufacturer>OLS</tds:Manufacturer>"
      "<tds:Model>Simulated PTZ</tds:Model><tds:FirmwareVersion>1.0</tds:FirmwareVersion>"
      "<tds:SerialNumber>{}</tds:SerialNumber><tds:HardwareId>1</tds:HardwareId>"
      "</tds:GetDeviceInformationResponse>",
      config_.serial);
}

std::string OnvifDevice::scopes(pugi::xml_node) {
  std::string all;
  for (const auto& scope : ptz_entity::scopes(config_)) {
    all += fmt::format(
        "<tds:Scopes><tt:ScopeDef>Fixed</tt:ScopeDef><tt:ScopeItem>{}</tt:ScopeItem></tds:Scopes>",
        scope);
  }
  return fmt::format("<tds:GetScopesResponse>{}</tds:GetScopesResponse>", all);
}

std::string OnvifDevice::media_capabilities(pugi::xml_node) {
  return R"(<trt:GetServiceCapabilitiesResponse><trt:Capabilities>)"
         R"(<trt:ProfileCapabilities MaximumNumberOfProfiles="1"/>)"
         R"(<trt:StreamingCapabilities RTPMulticast="false" RTP_TCP="true" RTP_RTSP_TCP="true"/>)"
         R"(</trt:Capabilities></trt:GetServiceCapabilitiesResponse>)";
}

std::string OnvifDevice::video_sources(pugi::xml_node) {
  return fmt::format(
      R"(<trt:GetVideoSourcesResponse><trt:VideoSources token="sensor">)"
      "<tt:Framerate>{}</tt:Framerate><tt:Resolution><tt:Width>{}</tt:Width>"
      "<tt:Height>{}</tt:Height></tt:Resolution></trt:VideoSources></trt:GetVideoSourcesResponse>",
      config_.frame_rate_hz, config_.width_px, config_.height_px);
}

std::string OnvifDevice::profiles(pugi::xml_node) {
  return fmt::format("<trt:GetProfilesResponse>{}</trt:GetProfilesResponse>",
                     profile_text(config_, "Profiles"));
}

std::string OnvifDevice::profile(pugi::xml_node request) {
  check_profile(request, onvif_space::kMedia);
  return fmt::format("<trt:GetProfileResponse>{}</trt:GetProfileResponse>",
                     profile_text(config_, "Profile"));
}

std::string OnvifDevice::stream_uri(pugi::xml_node request) {
  check_profile(request, onvif_space::kMedia);
  return fmt::format(
      "<trt:GetStreamUriResponse><trt:MediaUri><tt:Uri>{}</tt:Uri>"
      "<tt:InvalidAfterConnect>false</tt:InvalidAfterConnect>"
      "<tt:InvalidAfterReboot>false</tt:InvalidAfterReboot><tt:Timeout>PT0S</tt:Timeout>"
      "</trt:MediaUri></trt:GetStreamUriResponse>",
      config_.stream_uri);
}

std::string OnvifDevice::media2_capabilities(pugi::xml_node) {
  return R"(<tr2:GetServiceCapabilitiesResponse><tr2:Capabilities>)"
         R"(<tr2:ProfileCapabilities MaximumNumberOfProfiles="1" )"
         R"(ConfigurationsSupported="VideoSource VideoEncoder PTZ"/>)"
         R"(<tr2:StreamingCapabilities RTSPStreaming="true" RTP_RTSP_TCP="true"/>)"
         R"(</tr2:Capabilities></tr2:GetServiceCapabilitiesResponse>)";
}

std::string OnvifDevice::media2_profiles(pugi::xml_node) {
  const std::string encoder = fmt::format(
      R"(<tr2:VideoEncoder token="encoder"><tt:Name>encoder</tt:Name><tt:UseCount>1</tt:UseCount>)"
      R"(<tt:Encoding>{}</tt:Encoding><tt:Resolution><tt:Width>{}</tt:Width>)"
      R"(<tt:Height>{}</tt:Height></tt:Resolution><tt:RateControl>)"
      R"(<tt:FrameRateLimit>{}</tt:FrameRateLimit><tt:BitrateLimit>8000</tt:BitrateLimit>)"
      R"(</tt:RateControl><tt:Quality>5</tt:Quality></tr2:VideoEncoder>)",
      config_.encoding, config_.width_px, config_.height_px, config_.frame_rate_hz);
  return fmt::format(
      R"(<tr2:GetProfilesResponse><tr2:Profiles token="{0}" fixed="true"><tr2:Name>{0}</tr2:Name>)"
      R"(<tr2:Configurations>{1}{2}{3}</tr2:Configurations></tr2:Profiles>)"
      R"(</tr2:GetProfilesResponse>)",
      ptz_entity::kProfile, source_text(config_, "tr2:VideoSource"), encoder,
      ptz_entity::configuration("tr2:PTZ"));
}

std::string OnvifDevice::media2_stream_uri(pugi::xml_node request) {
  check_profile(request, onvif_space::kMedia2);
  return fmt::format("<tr2:GetStreamUriResponse><tr2:Uri>{}</tr2:Uri></tr2:GetStreamUriResponse>",
                     config_.stream_uri);
}

}  // namespace ols::sim
