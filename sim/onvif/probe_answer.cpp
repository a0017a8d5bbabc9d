#include "sim/onvif/probe_answer.h"

#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "base/files/fnv1a.h"
#include "sim/onvif/ptz_entities.h"
#include "sim/onvif/soap.h"

namespace ols::sim {
namespace {

constexpr const char* kDiscovery = "http://schemas.xmlsoap.org/ws/2005/04/discovery";
constexpr const char* kAddressing = "http://schemas.xmlsoap.org/ws/2004/08/addressing";
constexpr const char* kNetwork = "http://www.onvif.org/ver10/network/wsdl";

// The namespace of a qualified name in the text of this element, and the name.
XmlName qualified(pugi::xml_node element, const std::string& name) {
  const auto colon = name.find(':');
  const bool prefixed = colon != std::string::npos;
  const std::string declaration = prefixed ? "xmlns:" + name.substr(0, colon) : "xmlns";
  for (auto node = element; node; node = node.parent()) {
    if (const auto space = node.attribute(declaration.c_str()))
      return {space.value(), prefixed ? name.substr(colon + 1) : name};
  }
  return {"", name};
}

// All types that are asked for must be its own.
bool is_asked(pugi::xml_node types) {
  std::istringstream names(text_of(types));
  for (std::string name; names >> name;) {
    const XmlName type = qualified(types, name);
    if (type.space != kNetwork || type.local != "NetworkVideoTransmitter") return false;
  }
  return true;
}

// Always the same of one device.
std::string endpoint(const OnvifConfig& c) {
  return fmt::format("urn:uuid:00000000-0000-5000-8000-{:012x}",
                     fnv1a(c.serial + c.address) & 0xffffffffffffU);
}

}  // namespace

std::optional<std::string> probe_answer(const std::string& datagram, const OnvifConfig& c) {
  pugi::xml_document document;
  if (!document.load_buffer(datagram.data(), datagram.size())) return std::nullopt;
  const auto envelope = document.document_element();
  const auto header = child_of(envelope, onvif_space::kEnvelope, "Header");
  const auto body = child_of(envelope, onvif_space::kEnvelope, "Body");
  const auto probe = child_of(body, kDiscovery, "Probe");
  const std::string message = text_of(child_of(header, kAddressing, "MessageID"));
  if (!probe || message.empty() || !is_asked(child_of(probe, kDiscovery, "Types")))
    return std::nullopt;
  std::string scopes;
  for (const std::string& scope : ptz_entity::scopes(c)) scopes += scope + " ";
  return fmt::format(
      R"(<?xml version="1.0" encoding="UTF-8"?>)"
      R"(<env:Envelope xmlns:env="{0}" xmlns:wsa="{1}" xmlns:d="{2}" xmlns:dn="{3}"><env:Header>)"
      "<wsa:MessageID>{4}/{5}</wsa:MessageID><wsa:RelatesTo>{5}</wsa:RelatesTo>"
      "<wsa:To>{1}/role/anonymous</wsa:To><wsa:Action>{2}/ProbeMatches</wsa:Action></env:Header>"
      "<env:Body><d:ProbeMatches><d:ProbeMatch><wsa:EndpointReference><wsa:Address>{4}"
      "</wsa:Address></wsa:EndpointReference><d:Types>dn:NetworkVideoTransmitter</d:Types>"
      "<d:Scopes>{6}</d:Scopes><d:XAddrs>http://{7}:{8}/onvif/device_service</d:XAddrs>"
      "<d:MetadataVersion>1</d:MetadataVersion></d:ProbeMatch></d:ProbeMatches></env:Body>"
      "</env:Envelope>",
      onvif_space::kEnvelope, kAddressing, kDiscovery, kNetwork, endpoint(c), message, scopes,
      c.address, c.port);
}

}  // namespace ols::sim
