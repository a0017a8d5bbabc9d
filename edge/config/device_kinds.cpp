#include "edge/config/device_kinds.h"

#include "edge/camera/aravis/aravis_kind.h"
#include "edge/mount/fixed/fixed_kind.h"
#include "edge/ptu/ptu_kind.h"

namespace ols::station {

using device::make_kind;

const std::vector<device::KindRow<camera::CameraKind>>& camera_kinds() {
  static const std::vector<device::KindRow<camera::CameraKind>> kinds{
      {"aravis", "A GigE Vision camera.", make_kind<camera::AravisKind>}};
  return kinds;
}

const std::vector<device::KindRow<mount::MountKind>>& mount_kinds() {
  static const std::vector<device::KindRow<mount::MountKind>> kinds{
      {"flir", "A pan-tilt unit of FLIR (Directed Perception).", make_kind<ptu::PtuKind>},
      {"fixed", "The camera stands still: the station never moves it.",
       make_kind<mount::FixedKind>}};
  return kinds;
}

}  // namespace ols::station
