// The mount kinds for pan-tilt heads on serial lines (mount_kind.h), one for each protocol.
#pragma once

#include <memory>
#include <string>

#include "edge/mount/mount_kind.h"
#include "edge/mount/serial/serial_config.h"

namespace ols::serial_mount {

template <Language kLanguage>
class SerialKind : public mount::MountKind {
 public:
  config::Section section() override { return serial_section(serial, kLanguage); }
  mount::Traits traits() const override;
  std::string words() const override { return "head on " + serial.device; }
  std::unique_ptr<mount::Mount> open() const override;

  SerialConfig serial;
};

using PelcoDKind = SerialKind<Language::kPelcoD>;
using ViscaKind = SerialKind<Language::kVisca>;

}  // namespace ols::serial_mount
