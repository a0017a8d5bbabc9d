// Finds ONVIF cameras by their answers to a probe. Pure; discovery_link.* sends and receives.
// Source: WS-Discovery (April 2005), SOAP-over-UDP, ONVIF Core Specification 7.3.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ols::onvif {

struct FoundCamera {
  std::string id;    // of the device, whatever its address: "urn:uuid:..."
  std::string url;   // of its device service, at the host that answered
  std::string name;  // as it calls itself; empty: it does not
};

// The question to all cameras. `message_id`: "urn:uuid:...", never used before.
std::string probe(const std::string& message_id);

// Finds the cameras among everything that answers. An answer is refused, with the reason in words,
// if it is damaged, has a document type, answers another question, is of another kind of device,
// names no usable address at the host that sent it, or contradicts an earlier one.
class Discovery {
 public:
  static constexpr std::size_t kMostCameras = 64, kMostRefused = 32;

  explicit Discovery(std::string message_id) : message_id_(std::move(message_id)) {}

  // `sender`: the IP address that a datagram came from.
  void add(const std::string& datagram, const std::string& sender);

  const std::vector<FoundCamera>& cameras() const { return cameras_; }
  const std::vector<std::string>& refused() const { return refused_; }  // "10.0.0.5: no XAddrs"

 private:
  void add(FoundCamera camera);
  void refuse(const std::string& sender, const std::string& why);

  std::string message_id_;
  std::vector<FoundCamera> cameras_;
  std::vector<std::string> refused_;
};

}  // namespace ols::onvif
