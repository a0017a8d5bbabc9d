// An encoder writes records in one format: records come in, packets of bytes go out. Encoders use
// no clock, file or socket, and remember only records that they have received.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

// One datagram, one message of a stream, one MQTT message or one file.
struct Packet {
  std::string subject;  // a newer packet replaces a waiting packet of the same subject; empty: it
                        // replaces none
  std::string bytes{};
  std::string where{};       // an MQTT topic, or the suffix of a file's name
  bool is_retained = false;  // MQTT: the broker keeps the message for later subscribers
};
using Packets = std::vector<Packet>;

class Encoder {
 public:
  virtual ~Encoder() = default;

  virtual Packets encode(const Target& target) = 0;
  virtual Packets encode(const Station& station) = 0;
  virtual Packets encode(const Line& line) = 0;
  // Returns no packets if the format has no place for incidents.
  virtual Packets encode_incident(const Incident& incident) {
    static_cast<void>(incident);
    return {};
  }
  // The packets that do not belong to a single record, such as a document or a service status. Call
  // about once a second, or as often as a file shall be written. `utime_us`: now.
  virtual Packets due(std::int64_t utime_us) {
    static_cast<void>(utime_us);
    return {};
  }
  // Call when the receiver is new or may have forgotten everything. The encoder then sends again
  // what it sends only once.
  virtual void begin_again() {}
};

}  // namespace ols::exports
