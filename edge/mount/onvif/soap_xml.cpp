#include "edge/mount/onvif/soap_xml.h"

#include "base/text/plain_text.h"

namespace ols::onvif::soap_xml {

constexpr std::size_t kLongestWords = 120;

std::string_view local(std::string_view name) { return name.substr(name.find(':') + 1); }

pugi::xml_node child(const pugi::xml_node& parent, std::string_view name) {
  return parent.find_child([name](const auto& node) { return local(node.name()) == name; });
}

pugi::xml_node below(const pugi::xml_node& parent, std::string_view name) {
  return parent.find_node([name](const auto& node) { return local(node.name()) == name; });
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kSpace) - first + 1));
}

std::string text_of(const pugi::xml_node& node) { return trimmed(node.text().get()); }

std::string words(const std::string& text) { return plain_text(text.substr(0, kLongestWords)); }

}  // namespace ols::onvif::soap_xml
