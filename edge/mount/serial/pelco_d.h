// Pelco-D: seven bytes a message, FF, address, two of commands, two of data, and their sum without
// FF. Positions are degrees, 0 to 360, to a hundredth (extended commands 51, 53, 59, 5B to ask and
// answer, 4B and 4D to set). Source: Pelco, "D" Protocol Manual, revision 5.
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
