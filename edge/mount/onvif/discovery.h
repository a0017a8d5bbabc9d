// Finds ONVIF cameras by their answers to a probe, a question to all devices of a network. Pure;
// discovery_link.* sends and receives. Sources: WS-Discovery (April 2005), SOAP-over-UDP, ONVIF
// Core Specification 7.3.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ols::onvif {

struct FoundCamera {
  std::string id;    // identifies the device independently of its address: "urn:uuid:..."
  std::string url;   // address of the device service, at the host that answered
  std::string name;  // the camera's name for itself, with its model; empty if not stated
};

// The text of a probe. `message_id`: "urn:uuid:...", which must never have been used before.
std::string probe(const std::string& message_id);

// Collects the cameras from the answers to one probe. An answer is refused if it is damaged, has a
// document type, answers another probe, comes from another kind of device, contains no usable
// address at the host that sent it, or contradicts an earlier answer.
class Discovery {
 public:
  static constexpr std::size_t kMostCameras = 64, kMostRefused = 32;

  explicit Discovery(std::string message_id) : message_id_(std::move(message_id)) {}

  // Takes a received datagram. `sender`: IP address of the host that sent it.
  void add(const std::string& datagram, const std::string& sender);

  const std::vector<FoundCamera>& cameras() const { return cameras_; }
  // Sender and reason of each refused answer: "10.0.0.5: no XAddrs"
  const std::vector<std::string>& refused() const { return refused_; }

 private:
  void add(FoundCamera camera);
  void refuse(const std::string& sender, const std::string& why);

  std::string message_id_;
  std::vector<FoundCamera> cameras_;
  std::vector<std::string> refused_;
};

}  // namespace ols::onvif
