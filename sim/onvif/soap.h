// SOAP 1.2 as ONVIF uses it: names with namespaces, envelopes, faults. Pure.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace ols::sim {

namespace onvif_space {
constexpr const char* kEnvelope = "http://www.w3.org/2003/05/soap-envelope";
constexpr const char* kSchema = "http://www.onvif.org/ver10/schema";
constexpr const char* kDevice = "http://www.onvif.org/ver10/device/wsdl";
constexpr const char* kMedia2 = "http://www.onvif.org/ver20/media/wsdl";
constexpr const char* kMedia = "http://www.onvif.org/ver10/media/wsdl";
constexpr const char* kPtz = "http://www.onvif.org/ver20/ptz/wsdl";
}  // namespace onvif_space

// An XML element's namespace, and its name without the prefix.
struct XmlName {
  std::string space, local;
};
XmlName name_of(pugi::xml_node element);

// The first child element with this name; an empty node if there is none.
pugi::xml_node child_of(pugi::xml_node parent, std::string_view space, std::string_view local);
// The element's text, without white space around it.
std::string text_of(pugi::xml_node element);

struct SoapFault {
  std::string code = "Sender";        // Sender, Receiver or VersionMismatch
  std::vector<std::string> subcodes;  // from ONVIF's namespace of errors; the outermost first
  std::string reason;
  int http_status() const { return code == "Sender" ? 400 : 500; }
};

// The whole message with this body.
std::string enveloped(std::string_view body);
std::string enveloped(const SoapFault& fault);

// Converts a duration of XML Schema to seconds; NaN: not a duration, or one with years or months.
double duration_s(std::string_view text);
// Converts text to a finite number; NaN: not a finite number.
double number_of(std::string_view text);

}  // namespace ols::sim
