// The kinds of camera and mount that a station can have: what `kind` says in [camera] and [mount].
// A new kind is a folder of its own and a row here.
#pragma once

#include "edge/camera/camera_kind.h"
#include "edge/device/chosen_kind.h"
#include "edge/mount/mount_kind.h"

namespace ols::station {

using ChosenCamera = device::ChosenKind<camera::CameraKind>;
using ChosenMount = device::ChosenKind<mount::MountKind>;

// The first one is the default.
const std::vector<device::KindRow<camera::CameraKind>>& camera_kinds();
const std::vector<device::KindRow<mount::MountKind>>& mount_kinds();

}  // namespace ols::station
