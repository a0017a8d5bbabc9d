#include "edge/mount/onvif/discovery.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <pugixml.hpp>
#include <sstream>
#include <string_view>

#include "edge/mount/onvif/service_address.h"
#include "edge/mount/onvif/soap_answer.h"
#include "edge/mount/onvif/soap_xml.h"

namespace ols::onvif {
namespace {

using pugi::xml_node;
using namespace soap_xml;

constexpr std::string_view kCamera = "NetworkVideoTransmitter";
constexpr std::size_t kLongestId = 200, kLongestUrl = 500;

std::vector<std::string> listed(const std::string& text) {
  std::istringstream words(text);
  return {std::istream_iterator<std::string>(words), {}};
}

// Some devices write "uuid:", some "urn:uuid:".
std::string_view bare(std::string_view id) { return id.substr(id.rfind(':') + 1); }

// "%20" is a blank.
std::string decoded(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned char byte = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      result += static_cast<char>(byte);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::string scope(const std::vector<std::string>& scopes, std::string_view kind) {
  const std::string beginning = "onvif://www.onvif.org/" + std::string(kind) + "/";
  for (const std::string& one : scopes) {
    if (one.starts_with(beginning)) return words(decoded(one.substr(beginning.size())));
  }
  return {};
}

// The name, and the model unless the name has it.
std::string name_in(const std::string& text) {
  const auto scopes = listed(text);
  const std::string name = scope(scopes, "name"), hardware = scope(scopes, "hardware");
  if (name.find(hardware) != std::string::npos) return name;
  return name.empty() ? hardware : name + ", " + hardware;
}

bool is_usable(const std::string& url) {
  try {
    check_address(url);
  } catch (const std::invalid_argument&) {
    return false;
  }
  return url.size() <= kLongestUrl;
}

// An address at another host is not used: the user's password would go there.
std::string address_at(const std::string& sender, const std::vector<std::string>& addresses) {
  if (addresses.empty()) throw AnswerError("no XAddrs");
  for (const std::string& url : addresses) {
    if (is_usable(url) && host_of(url) == sender) return url;
  }
  throw AnswerError("no address of its own: " + words(addresses.front()));
}

FoundCamera camera_in(const xml_node& match, const std::string& sender) {
  const auto types = listed(text_of(child(match, "Types")));
  if (std::ranges::none_of(types, [](const auto& type) { return local(type) == kCamera; }))
    throw AnswerError("no camera: " + words(text_of(child(match, "Types"))));
  FoundCamera camera;
  camera.id = text_of(child(child(match, "EndpointReference"), "Address"));
  if (camera.id.empty() || camera.id.size() > kLongestId) throw AnswerError("no usable Address");
  camera.id = words(camera.id);
  camera.url = address_at(sender, listed(text_of(child(match, "XAddrs"))));
  camera.name = name_in(text_of(child(match, "Scopes")));
  return camera;
}

xml_node matches_in(const pugi::xml_document& document, const std::string& message_id) {
  for (const xml_node& node : document.children()) {
    if (node.type() == pugi::node_doctype) throw AnswerError("has a document type");
  }
  const xml_node envelope = child(document, "Envelope");
  const xml_node matches = child(child(envelope, "Body"), "ProbeMatches");
  if (!matches) throw AnswerError("no ProbeMatches");
  const std::string question = text_of(child(child(envelope, "Header"), "RelatesTo"));
  if (bare(question) != bare(message_id)) throw AnswerError("answers another question");
  return matches;
}

}  // namespace

std::string probe(const std::string& message_id) {
  constexpr const char* kDiscovery = "http://schemas.xmlsoap.org/ws/2005/04/discovery";
  constexpr const char* kAddressing = "http://schemas.xmlsoap.org/ws/2004/08/addressing";
  const std::string d = kDiscovery, a = kAddressing;
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>"
         "<s:Envelope xmlns:s=\"http://www.w3.org/2003/05/soap-envelope\" xmlns:a=\"" +
         a + "\" xmlns:d=\"" + d + "\"><s:Header><a:Action s:mustUnderstand=\"1\">" + d +
         "/Probe</a:Action><a:MessageID>" + message_id + "</a:MessageID><a:ReplyTo><a:Address>" +
         a + "/role/anonymous</a:Address></a:ReplyTo><a:To s:mustUnderstand=\"1\">" +
         "urn:schemas-xmlsoap-org:ws:2005:04:discovery</a:To></s:Header><s:Body><d:Probe>" +
         "<d:Types xmlns:n=\"http://www.onvif.org/ver10/network/wsdl\">n:" + std::string(kCamera) +
         "</d:Types></d:Probe></s:Body></s:Envelope>";
}

void Discovery::refuse(const std::string& sender, const std::string& why) {
  const std::string text = sender + ": " + why;
  if (refused_.size() < kMostRefused && std::ranges::find(refused_, text) == refused_.end())
    refused_.push_back(text);
}

// A camera answers each probe, on each of its networks.
void Discovery::add(FoundCamera camera) {
  for (const FoundCamera& known : cameras_) {
    if (known.id == camera.id && known.url == camera.url) return;
    if (known.id == camera.id) throw AnswerError("the same camera as " + known.url);
    if (known.url == camera.url) throw AnswerError("another camera at " + known.url);
  }
  if (cameras_.size() == kMostCameras) throw AnswerError("too many cameras");
  cameras_.push_back(std::move(camera));
}

void Discovery::add(const std::string& datagram, const std::string& sender) {
  pugi::xml_document document;
  const bool good = document.load_buffer(datagram.data(), datagram.size(),
                                         pugi::parse_default | pugi::parse_doctype);
  try {
    if (!good) throw AnswerError("no XML");
    for (const xml_node& match : matches_in(document, message_id_).children()) {
      if (local(match.name()) != "ProbeMatch") continue;
      try {
        add(camera_in(match, sender));
      } catch (const AnswerError& error) {
        refuse(sender, error.what());
      }
    }
  } catch (const AnswerError& error) {
    refuse(sender, error.what());
  }
}

}  // namespace ols::onvif
