// Reads SOAP texts by the local names of their elements. Pure.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace ols::onvif::soap_xml {

// "Body" of "s:Body".
std::string_view local(std::string_view name);
// An empty node if there is none.
pugi::xml_node child(const pugi::xml_node& parent, std::string_view name);
pugi::xml_node below(const pugi::xml_node& parent, std::string_view name);

// Without white space around it.
std::string trimmed(std::string_view text);
std::string text_of(const pugi::xml_node& node);

// The beginning of a camera's text, fit for a log.
std::string words(const std::string& text);

}  // namespace ols::onvif::soap_xml
