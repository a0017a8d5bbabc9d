// Pelco-D. A message has seven bytes: FF, address, two of commands, two of data, and the sum of all
// but FF. Positions are degrees, 0 to 360, in hundredths. The extended commands 51 and 53 ask for
// them, 59 and 5B answer, 4B and 4D set them. Source: Pelco, "D" Protocol Manual, revision 5.
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
