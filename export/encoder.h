// One format: records in, bytes out. Encoders have no clock, file or socket; whatever memory they
// have is of what they were told.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "export/records.h"

namespace ols::exports {

// One datagram, message of a stream, MQTT message or file.
struct Packet {
  std::string subject;  // a newer one of the same subject replaces it; empty: none replaces it
  std::string bytes{};
  std::string where{};       // an MQTT topic, or what is put behind the name of a file
  bool is_retained = false;  // MQTT
};
using Packets = std::vector<Packet>;

class Encoder {
 public:
  virtual ~Encoder() = default;

  virtual Packets encode(const Target& target) = 0;
  virtual Packets encode(const Station& station) = 0;
  virtual Packets encode(const Line& line) = 0;
  // What the format sends of its own accord, about once a second, or as often as a file is to be
  // written: a document, a service's status. `utime_us`: now.
  virtual Packets turn(std::int64_t utime_us) {
    static_cast<void>(utime_us);
    return {};
  }
  // The receiver is new, or has forgotten: what was told once is to be told again.
  virtual void begin_again() {}
};

}  // namespace ols::exports
