// The arguments of PTZ moves in ONVIF's generic spaces. Pure.
#pragma once

#include <optional>
#include <pugixml.hpp>

#include "sim/onvif/ptz_scale.h"

namespace ols::sim {

// URIs of the spaces of pan and tilt.
namespace ptz_space {
constexpr const char* kPosition =
    "http://www.onvif.org/ver10/tptz/PanTiltSpaces/PositionGenericSpace";
constexpr const char* kTranslation =
    "http://www.onvif.org/ver10/tptz/PanTiltSpaces/TranslationGenericSpace";
constexpr const char* kVelocity =
    "http://www.onvif.org/ver10/tptz/PanTiltSpaces/VelocityGenericSpace";
constexpr const char* kSpeed = "http://www.onvif.org/ver10/tptz/PanTiltSpaces/GenericSpeedSpace";
}  // namespace ptz_space

constexpr double kLeastTimeout_s = 0.1, kGreatestTimeout_s = 60.0, kDefaultTimeout_s = 5.0;

// The element `name` of a move with its PanTilt. nullopt: there is no PanTilt. Throws SoapFault if
// the element is missing though `required`, with `invalid` if a value is outside [least, 1].
std::optional<PtzVector> pan_tilt_of(pugi::xml_node move, const char* name, bool required,
                                     const char* space, double least, const char* invalid);

// [s]. Throws SoapFault.
double timeout_of(pugi::xml_node move);

}  // namespace ols::sim
