// The PTZ service.

#include <fmt/format.h>

#include <algorithm>

#include "sim/onvif/device.h"
#include "sim/onvif/ptz_entities.h"
#include "sim/onvif/ptz_spaces.h"

namespace ols::sim {
namespace {

constexpr PtzUnit::Axis kAxes[] = {PtzUnit::kPan, PtzUnit::kTilt};

// Throws for any token but the only one.
void check_token(pugi::xml_node request, const char* element, const char* token,
                 const char* subcode) {
  if (text_of(child_of(request, onvif_space::kPtz, element)) == token) return;
  throw SoapFault{"Sender", {"InvalidArgVal", subcode}, std::string(element) + " is not known"};
}

void check_profile(pugi::xml_node request) {
  check_token(request, "ProfileToken", ptz_entity::kProfile, "NoProfile");
}

PtzVector speed_of(pugi::xml_node request) {
  const auto given = pan_tilt_of(request, "Speed", false, ptz_space::kSpeed, 0.0, "InvalidSpeed");
  return given.value_or(PtzVector{1.0, 1.0});
}

}  // namespace

std::string OnvifDevice::ptz_capabilities(pugi::xml_node) {
  return R"(<tptz:GetServiceCapabilitiesResponse><tptz:Capabilities EFlip="false" Reverse="false" )"
         R"(MoveStatus="true" StatusPosition="true"/></tptz:GetServiceCapabilitiesResponse>)";
}

std::string OnvifDevice::nodes(pugi::xml_node) {
  return "<tptz:GetNodesResponse>" + ptz_entity::node() + "</tptz:GetNodesResponse>";
}

std::string OnvifDevice::node(pugi::xml_node request) {
  check_token(request, "NodeToken", ptz_entity::kNode, "NoEntity");
  return "<tptz:GetNodeResponse>" + ptz_entity::node() + "</tptz:GetNodeResponse>";
}

std::string OnvifDevice::configurations(pugi::xml_node) {
  return "<tptz:GetConfigurationsResponse>" + ptz_entity::configuration("tptz:PTZConfiguration") +
         "</tptz:GetConfigurationsResponse>";
}

std::string OnvifDevice::configuration(pugi::xml_node request) {
  check_token(request, "PTZConfigurationToken", ptz_entity::kConfiguration, "NoConfig");
  return "<tptz:GetConfigurationResponse>" + ptz_entity::configuration("tptz:PTZConfiguration") +
         "</tptz:GetConfigurationResponse>";
}

std::string OnvifDevice::configuration_options(pugi::xml_node request) {
  check_token(request, "ConfigurationToken", ptz_entity::kConfiguration, "NoConfig");
  return "<tptz:GetConfigurationOptionsResponse>" + ptz_entity::options() +
         "</tptz:GetConfigurationOptionsResponse>";
}

std::string OnvifDevice::status(pugi::xml_node request) {
  check_profile(request);
  std::string position;
  if (const auto reported = unit_.reported(time_s_)) {
    const PtzVector at = generic(*reported, config_.unit);
    position =
        fmt::format(R"(<tt:Position><tt:PanTilt x="{:.6f}" y="{:.6f}" space="{}"/></tt:Position>)",
                    at[0], at[1], ptz_space::kPosition);
  }
  return fmt::format(
      "<tptz:GetStatusResponse><tptz:PTZStatus>{}<tt:MoveStatus><tt:PanTilt>{}</tt:PanTilt>"
      "</tt:MoveStatus><tt:UtcTime>{}</tt:UtcTime></tptz:PTZStatus></tptz:GetStatusResponse>",
      position, unit_.moves(time_s_) ? "MOVING" : "IDLE", date_time_of(utime_us_));
}

std::string OnvifDevice::continuous_move(pugi::xml_node request) {
  check_profile(request);
  const auto velocity =
      pan_tilt_of(request, "Velocity", true, ptz_space::kVelocity, -1.0, "InvalidVelocity");
  const double timeout_s = timeout_of(request);
  if (velocity) {
    for (const auto axis : kAxes) {
      unit_.drive(axis, velocity->at(axis) * full_speed_rad_s(axis, config_.unit), timeout_s,
                  time_s_);
    }
  }
  return "<tptz:ContinuousMoveResponse/>";
}

std::string OnvifDevice::absolute_move(pugi::xml_node request) {
  check_profile(request);
  const auto position =
      pan_tilt_of(request, "Position", true, ptz_space::kPosition, -1.0, "InvalidPosition");
  go_to(position, request);
  return "<tptz:AbsoluteMoveResponse/>";
}

std::string OnvifDevice::relative_move(pugi::xml_node request) {
  check_profile(request);
  auto position = pan_tilt_of(request, "Translation", true, ptz_space::kTranslation, -1.0,
                              "InvalidTranslation");
  if (position) {
    const PtzVector here = generic(unit_.angles_at(time_s_), config_.unit);
    for (const auto axis : kAxes)
      position->at(axis) = std::clamp(here.at(axis) + position->at(axis), -1.0, 1.0);
  }
  go_to(position, request);
  return "<tptz:RelativeMoveResponse/>";
}

void OnvifDevice::go_to(const std::optional<PtzVector>& position, pugi::xml_node request) {
  const PtzVector speed = speed_of(request);
  if (!position) return;
  for (const auto axis : kAxes) {
    if (speed.at(axis) == 0.0) continue;
    unit_.go_to(axis, angle_rad(axis, position->at(axis), config_.unit),
                speed.at(axis) * config_.unit.max_speed_rad_s, time_s_);
  }
}

std::string OnvifDevice::stop(pugi::xml_node request) {
  check_profile(request);
  const std::string pan_tilt = text_of(child_of(request, onvif_space::kPtz, "PanTilt"));
  if (pan_tilt != "false" && pan_tilt != "0") unit_.stop(time_s_);
  return "<tptz:StopResponse/>";
}

}  // namespace ols::sim
