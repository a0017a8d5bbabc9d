// The interface of the protocols of pan-tilt heads on serial lines. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/kinematic_chain.h"

namespace ols::serial_mount {

class LineProtocol {
 public:
  LineProtocol() = default;
  virtual ~LineProtocol() = default;
  LineProtocol(const LineProtocol&) = delete;
  LineProtocol& operator=(const LineProtocol&) = delete;

  // The requests for the head's position. Each is sent after the previous one was answered.
  virtual std::vector<std::string> questions() const = 0;
  virtual std::string stop() const = 0;
  // Orders a motion. `pan`, `tilt`: shares of the maximum speeds, -1 to 1; positive is left and up.
  virtual std::string velocity(double pan, double tilt) const = 0;
  // Orders a move to a position in the head's units.
  virtual std::string place(double pan, double tilt) const = 0;

  // Takes received bytes, split in any way. Bytes that form no message are counted (garbled()).
  virtual void receive(std::string_view bytes) = 0;
  // The newest position in the head's units. Each axis is nullopt until an answer has arrived after
  // restart().
  struct Position {
    std::optional<double> pan, tilt;
  };
  const Position& position() const { return position_; }
  std::uint64_t garbled() const { return garbled_; }
  void restart() { position_ = {}; }

 protected:
  Position position_;
  std::uint64_t garbled_ = 0;
};

}  // namespace ols::serial_mount
