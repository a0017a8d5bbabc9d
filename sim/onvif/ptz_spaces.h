// Reads the arguments of PTZ moves in ONVIF's generic spaces. Pure.
#pragma once

#include <optional>
#include <pugixml.hpp>

#include "sim/onvif/ptz_scale.h"

namespace ols::sim {

// URIs of the generic spaces for pan and tilt.
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

// Reads PanTilt from the element `name` of a move; nullopt: it has none. Throws SoapFault if a
// `required` element is missing, or, with the subcode `invalid`, if a value is outside [least, 1].
std::optional<PtzVector> pan_tilt_of(pugi::xml_node move, const char* name, bool required,
                                     const char* space, double least, const char* invalid);

// The timeout of a move [s]. Throws SoapFault.
double timeout_of(pugi::xml_node move);

}  // namespace ols::sim
