#include "edge/mount/serial/serial_kinds.h"

#include "edge/mount/serial/pelco_d.h"
#include "edge/mount/serial/serial_session.h"
#include "edge/mount/serial/visca_head.h"

namespace ols::serial_mount {

template <Language kLanguage>
mount::Traits SerialKind<kLanguage>::traits() const {
  return mount::driven_traits(serial.drive);
}

template <Language kLanguage>
std::unique_ptr<mount::Mount> SerialKind<kLanguage>::open() const {
  std::unique_ptr<LineProtocol> protocol;
  if (kLanguage == Language::kPelcoD) {
    protocol = std::make_unique<PelcoD>(serial.address);
  } else {
    protocol = std::make_unique<ViscaHead>();
  }
  return std::make_unique<mount::DrivenMount>(
      serial.drive, std::make_unique<SerialSession>(serial, std::move(protocol)));
}

template class SerialKind<Language::kPelcoD>;
template class SerialKind<Language::kVisca>;

}  // namespace ols::serial_mount
