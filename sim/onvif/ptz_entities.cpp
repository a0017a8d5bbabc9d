#include "sim/onvif/ptz_entities.h"

#include <fmt/format.h>

#include "sim/onvif/ptz_spaces.h"

namespace ols::sim::ptz_entity {
namespace {

std::string space(const char* element, const char* uri) {
  return fmt::format(
      "<tt:{0}><tt:URI>{1}</tt:URI><tt:XRange><tt:Min>-1</tt:Min><tt:Max>1</tt:Max></tt:XRange>"
      "<tt:YRange><tt:Min>-1</tt:Min><tt:Max>1</tt:Max></tt:YRange></tt:{0}>",
      element, uri);
}

std::string spaces() {
  return space("AbsolutePanTiltPositionSpace", ptz_space::kPosition) +
         space("RelativePanTiltTranslationSpace", ptz_space::kTranslation) +
         space("ContinuousPanTiltVelocitySpace", ptz_space::kVelocity) +
         fmt::format(
             "<tt:PanTiltSpeedSpace><tt:URI>{}</tt:URI><tt:XRange><tt:Min>0</tt:Min>"
             "<tt:Max>1</tt:Max></tt:XRange></tt:PanTiltSpeedSpace>",
             ptz_space::kSpeed);
}

}  // namespace

std::string node() {
  return fmt::format(R"(<tptz:PTZNode token="{0}" FixedHomePosition="true"><tt:Name>{0}</tt:Name>)"
                     "<tt:SupportedPTZSpaces>{1}</tt:SupportedPTZSpaces>"
                     "<tt:MaximumNumberOfPresets>0</tt:MaximumNumberOfPresets>"
                     "<tt:HomeSupported>false</tt:HomeSupported></tptz:PTZNode>",
                     kNode, spaces());
}

std::string configuration(const char* element) {
  return fmt::format(
      R"(<{0} token="{1}"><tt:Name>{1}</tt:Name><tt:UseCount>1</tt:UseCount>)"
      "<tt:NodeToken>{2}</tt:NodeToken>"
      "<tt:DefaultAbsolutePantTiltPositionSpace>{3}</tt:DefaultAbsolutePantTiltPositionSpace>"
      "<tt:DefaultRelativePanTiltTranslationSpace>{4}</tt:DefaultRelativePanTiltTranslationSpace>"
      "<tt:DefaultContinuousPanTiltVelocitySpace>{5}</tt:DefaultContinuousPanTiltVelocitySpace>"
      R"(<tt:DefaultPTZSpeed><tt:PanTilt x="1" y="1" space="{6}"/></tt:DefaultPTZSpeed>)"
      "<tt:DefaultPTZTimeout>PT{7}S</tt:DefaultPTZTimeout>"
      "<tt:PanTiltLimits>{8}</tt:PanTiltLimits></{0}>",
      element, kConfiguration, kNode, ptz_space::kPosition, ptz_space::kTranslation,
      ptz_space::kVelocity, ptz_space::kSpeed, kDefaultTimeout_s,
      space("Range", ptz_space::kPosition));
}

std::string options() {
  return fmt::format(
      "<tptz:PTZConfigurationOptions><tt:Spaces>{}</tt:Spaces>"
      "<tt:PTZTimeout><tt:Min>PT{}S</tt:Min><tt:Max>PT{}S</tt:Max></tt:PTZTimeout>"
      "</tptz:PTZConfigurationOptions>",
      spaces(), kLeastTimeout_s, kGreatestTimeout_s);
}

std::vector<std::string> scopes(const OnvifConfig& config) {
  return {"onvif://www.onvif.org/Profile/Streaming", "onvif://www.onvif.org/type/video_encoder",
          "onvif://www.onvif.org/type/ptz", "onvif://www.onvif.org/hardware/Simulated_PTZ",
          "onvif://www.onvif.org/name/" + config.serial};
}

}  // namespace ols::sim::ptz_entity
