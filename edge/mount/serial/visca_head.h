// Pan and tilt by Sony's protocol VISCA (edge/lens/visca.h describes the packets). Command 06 01
// orders a velocity, 06 02 orders a position, and 09 06 12 asks for the position. Positions are
// signed counts of the camera; right and up are positive. Source: Sony, EVI-D100 Command List.
#pragma once

#include <string>
#include <string_view>

#include "edge/lens/visca.h"
#include "edge/mount/serial/line_protocol.h"

namespace ols::serial_mount {

class ViscaHead : public LineProtocol {
 public:
  std::vector<std::string> questions() const override;
  std::string stop() const override;
  std::string velocity(double pan, double tilt) const override;
  std::string place(double pan, double tilt) const override;
  void receive(std::string_view bytes) override;

 private:
  lens::visca::Packets packets_;
};

}  // namespace ols::serial_mount
