// Helpers to read SOAP texts by the local names of their elements. Pure.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace ols::onvif::soap_xml {

// The local name: "Body" for "s:Body".
std::string_view local(std::string_view name);
// child(): the first child with this local name. below(): the first node with this local name at
// any depth. Both return an empty node if there is none.
pugi::xml_node child(const pugi::xml_node& parent, std::string_view name);
pugi::xml_node below(const pugi::xml_node& parent, std::string_view name);

// The text without white space at its beginning and end.
std::string trimmed(std::string_view text);
std::string text_of(const pugi::xml_node& node);

// The first 120 bytes of a camera's text, made printable for a log.
std::string words(const std::string& text);

}  // namespace ols::onvif::soap_xml
