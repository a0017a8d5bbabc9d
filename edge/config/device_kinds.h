// The kinds of devices that a station supports: the values of the key `kind` in [camera], [mount],
// [gnss] and [inclinometer]. A new kind needs its own folder and a row in one of these tables.
#pragma once

#include "edge/camera/camera_kind.h"
#include "edge/device/chosen_kind.h"
#include "edge/mount/mount_kind.h"
#include "edge/sensors/gnss.h"
#include "edge/sensors/inclinometer.h"

namespace ols::station {

using ChosenCamera = device::ChosenKind<camera::CameraKind>;
using ChosenMount = device::ChosenKind<mount::MountKind>;
using ChosenGnss = device::ChosenKind<sensors::GnssKind>;
using ChosenInclinometer = device::ChosenKind<sensors::InclinometerKind>;

// In each table, the first kind is the default.
const std::vector<device::KindRow<camera::CameraKind>>& camera_kinds();
const std::vector<device::KindRow<mount::MountKind>>& mount_kinds();
const std::vector<device::KindRow<sensors::GnssKind>>& gnss_kinds();
const std::vector<device::KindRow<sensors::InclinometerKind>>& inclinometer_kinds();

}  // namespace ols::station
