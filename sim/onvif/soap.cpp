#include "sim/onvif/soap.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>

namespace ols::sim {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string_view trimmed(std::string_view text) {
  constexpr const char* kWhite = " \t\r\n";
  const auto begin = text.find_first_not_of(kWhite);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kWhite) - begin + 1);
}

std::string subcode_text(const std::vector<std::string>& subcodes) {
  std::string text;
  for (auto code = subcodes.rbegin(); code != subcodes.rend(); ++code) {
    text = fmt::format("<env:Subcode><env:Value>ter:{}</env:Value>{}</env:Subcode>", *code, text);
  }
  return text;
}

}  // namespace

XmlName name_of(pugi::xml_node element) {
  const std::string name = element.name();
  const auto colon = name.find(':');
  const bool prefixed = colon != std::string::npos;
  const std::string declaration = prefixed ? "xmlns:" + name.substr(0, colon) : "xmlns";
  XmlName found{"", prefixed ? name.substr(colon + 1) : name};
  for (auto node = element; node; node = node.parent()) {
    const auto space = node.attribute(declaration.c_str());
    if (!space) continue;
    found.space = space.value();
    break;
  }
  return found;
}

pugi::xml_node child_of(pugi::xml_node parent, std::string_view space, std::string_view local) {
  for (const auto child : parent.children()) {
    if (child.type() != pugi::node_element) continue;
    const XmlName name = name_of(child);
    if (name.local == local && name.space == space) return child;
  }
  return {};
}

std::string text_of(pugi::xml_node element) { return std::string(trimmed(element.text().get())); }

std::string enveloped(std::string_view body) {
  return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>)"
                     R"(<env:Envelope xmlns:env="{}" xmlns:tt="{}" xmlns:tds="{}" xmlns:trt="{}" )"
                     R"(xmlns:tr2="{}" xmlns:tptz="{}">)"
                     R"(<env:Body>{}</env:Body></env:Envelope>)",
                     onvif_space::kEnvelope, onvif_space::kSchema, onvif_space::kDevice,
                     onvif_space::kMedia, onvif_space::kMedia2, onvif_space::kPtz, body);
}

std::string enveloped(const SoapFault& fault) {
  return enveloped(
      fmt::format(R"(<env:Fault xmlns:ter="http://www.onvif.org/ver10/error">)"
                  R"(<env:Code><env:Value>env:{}</env:Value>{}</env:Code>)"
                  R"(<env:Reason><env:Text xml:lang="en">{}</env:Text></env:Reason></env:Fault>)",
                  fault.code, subcode_text(fault.subcodes), fault.reason));
}

double number_of(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = kNaN;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? value : kNaN;
}

double duration_s(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 3 || !text.starts_with('P')) return kNaN;
  text.remove_prefix(1);
  double sum_s = 0.0;
  bool is_time = false;
  while (!text.empty()) {
    if (text.starts_with('T') && !is_time) {
      is_time = true;
      text.remove_prefix(1);
      continue;
    }
    const auto digits = text.find_first_not_of("0123456789.");
    if (digits == std::string_view::npos) return kNaN;
    const double value = number_of(text.substr(0, digits));
    const char unit = text[digits];
    if (!is_time && unit == 'D')
      sum_s += 86400.0 * value;
    else if (is_time && unit == 'H')
      sum_s += 3600.0 * value;
    else if (is_time && unit == 'M')
      sum_s += 60.0 * value;
    else if (is_time && unit == 'S')
      sum_s += value;
    else
      return kNaN;
    text.remove_prefix(digits + 1);
  }
  return sum_s;
}

}  // namespace ols::sim
