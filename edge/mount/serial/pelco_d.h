// The protocol Pelco-D. A message has seven bytes: FF, the address, two bytes of command, two bytes
// of data, and the sum of all bytes but FF. Positions are integers in hundredths of a degree, 0 to
// 360 degrees. The extended commands 51 and 53 ask for pan and tilt, 59 and 5B are the answers, and
// 4B and 4D order a position. Source: Pelco, "D" Protocol Manual, revision 5.
#pragma once

#include <string>
#include <string_view>

#include "edge/mount/serial/line_protocol.h"

namespace ols::serial_mount {

class PelcoD : public LineProtocol {
 public:
  explicit PelcoD(int address) : address_(address) {}  // 1..255

  std::vector<std::string> questions() const override;
  std::string stop() const override;
  std::string velocity(double pan, double tilt) const override;
  std::string place(double pan, double tilt) const override;
  void receive(std::string_view bytes) override;

 private:
  std::string message(int command, int data_1, int data_2) const;

  int address_;
  std::string received_;
};

}  // namespace ols::serial_mount
