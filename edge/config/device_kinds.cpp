#include "edge/config/device_kinds.h"

#include "edge/camera/aravis/aravis_kind.h"
#include "edge/camera/rtsp/rtsp_kind.h"
#include "edge/camera/v4l2/v4l2_kind.h"
#include "edge/mount/fixed/fixed_kind.h"
#include "edge/mount/indi/indi_kind.h"
#include "edge/mount/onvif/onvif_kind.h"
#include "edge/mount/serial/serial_kinds.h"
#include "edge/ptu/ptu_kind.h"
#include "edge/sensors/dpg2/dpg2_kind.h"
#include "edge/sensors/gpsd/gpsd_kind.h"

namespace ols::station {

using device::make_kind;

const std::vector<device::KindRow<camera::CameraKind>>& camera_kinds() {
  static const std::vector<device::KindRow<camera::CameraKind>> kinds{
      {"aravis", "A GigE Vision camera.", make_kind<camera::AravisKind>},
      {"rtsp", "An IP camera that sends a video stream by RTSP: H.264, H.265 or Motion JPEG.",
       make_kind<camera::RtspKind>},
      {"v4l2", "A camera that Linux drives (Video4Linux2), as USB cameras (UVC).",
       make_kind<camera::V4l2Kind>}};
  return kinds;
}

const std::vector<device::KindRow<mount::MountKind>>& mount_kinds() {
  static const std::vector<device::KindRow<mount::MountKind>> kinds{
      {"flir", "A pan-tilt unit of FLIR (Directed Perception).", make_kind<ptu::PtuKind>},
      {"fixed", "The camera stands still: the station never moves it.",
       make_kind<mount::FixedKind>},
      {"onvif", "An IP camera with pan and tilt that is steered by ONVIF.",
       make_kind<onvif::OnvifKind>},
      {"indi", "A telescope mount behind an INDI server, equatorial or altazimuth.",
       make_kind<indi::IndiKind>},
      {"pelco-d", "A pan-tilt head on a serial line that speaks Pelco-D and reports positions.",
       make_kind<serial_mount::PelcoDKind>},
      {"visca", "A camera with pan and tilt on a serial line that speaks Sony's VISCA.",
       make_kind<serial_mount::ViscaKind>}};
  return kinds;
}

const std::vector<device::KindRow<sensors::GnssKind>>& gnss_kinds() {
  static const std::vector<device::KindRow<sensors::GnssKind>> kinds{
      {"gpsd", "A receiver that gpsd reads.", make_kind<sensors::GpsdKind>}};
  return kinds;
}

const std::vector<device::KindRow<sensors::InclinometerKind>>& inclinometer_kinds() {
  static const std::vector<device::KindRow<sensors::InclinometerKind>> kinds{
      {"dpg2", "A TE DPG2 on a serial line.", make_kind<sensors::Dpg2Kind>}};
  return kinds;
}

}  // namespace ols::station
