#include "sim/onvif/ptz_spaces.h"

#include <string>

#include "sim/onvif/soap.h"

namespace ols::sim {

std::optional<PtzVector> pan_tilt_of(pugi::xml_node move, const char* name, bool required,
                                     const char* space, double least, const char* invalid) {
  const auto element = child_of(move, onvif_space::kPtz, name);
  if (!element && required)
    throw SoapFault{"Sender", {"InvalidArgs"}, std::string(name) + " is missing"};
  const auto vector = child_of(element, onvif_space::kSchema, "PanTilt");
  if (!vector) return std::nullopt;
  const auto named = vector.attribute("space");
  if (named && std::string_view(named.value()) != space) {
    throw SoapFault{"Sender",
                    {"InvalidArgVal", "SpaceNotSupported"},
                    "A space is referenced in an argument which is not supported by the PTZ Node"};
  }
  PtzVector values{};
  for (const int axis : {0, 1}) {
    values.at(axis) = number_of(vector.attribute(axis == 0 ? "x" : "y").value());
    if (!(values.at(axis) >= least && values.at(axis) <= 1.0)) {
      throw SoapFault{"Sender",
                      {"InvalidArgVal", invalid},
                      "The requested " + std::string(name) + " is out of bounds"};
    }
  }
  return values;
}

double timeout_of(pugi::xml_node move) {
  const auto element = child_of(move, onvif_space::kPtz, "Timeout");
  if (!element) return kDefaultTimeout_s;
  const double value_s = duration_s(text_of(element));
  if (!(value_s >= kLeastTimeout_s && value_s <= kGreatestTimeout_s)) {
    throw SoapFault{"Sender",
                    {"InvalidArgVal", "TimeoutNotSupported"},
                    "The specified timeout argument is not within the supported timeout range"};
  }
  return value_s;
}

}  // namespace ols::sim
