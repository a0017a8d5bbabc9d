// One format: records in, bytes out. Encoders use no clock, file or socket, and remember only
// records that they received.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

// One datagram, message of a stream, MQTT message or file.
struct Packet {
  std::string subject;  // a newer packet replaces a waiting one with the same subject; empty: it
                        // replaces none
  std::string bytes{};
  std::string where{};       // an MQTT topic, or the suffix of a file's name
  bool is_retained = false;  // MQTT
};
using Packets = std::vector<Packet>;

class Encoder {
 public:
  virtual ~Encoder() = default;

  virtual Packets encode(const Target& target) = 0;
  virtual Packets encode(const Station& station) = 0;
  virtual Packets encode(const Line& line) = 0;
  // Returns nothing if the format has no place for incidents.
  virtual Packets encode_incident(const Incident& incident) {
    static_cast<void>(incident);
    return {};
  }
  // The packets that the format sends without a record, such as a document or a service status.
  // Call about once a second, or as often as a file is written. `utime_us`: now.
  virtual Packets due(std::int64_t utime_us) {
    static_cast<void>(utime_us);
    return {};
  }
  // The receiver is new or has forgotten everything: what is sent only once must be sent again.
  virtual void begin_again() {}
};

}  // namespace ols::exports
