#include "edge/mount/fixed/fixed_kind.h"

#include "edge/config/config_units.h"

namespace ols::mount {

config::Section FixedKind::section() {
  PanTilt& angles = fixed.angles;
  return {"mount",
          "",
          {config::number("pan_deg", angles.pan_rad, {-180.0, 180.0}, station::in_degrees(),
                          "Pan angle at which the camera stands, from the heading of [pose]."),
           config::number("tilt_deg", angles.tilt_rad, {-90.0, 90.0}, station::in_degrees(),
                          "Tilt angle at which the camera stands.")}};
}

Traits FixedKind::traits() const {
  Traits traits;
  traits.moves = traits.may_home = false;
  traits.angles.step_rad = kVirtualCount_rad;
  traits.angles.acceleration_sd_rad_s2 = traits.angles.acceleration_max_rad_s2 = 0.0;
  traits.limits = fixed_limits(fixed.angles);
  return traits;
}

std::string FixedKind::words() const { return fixed_words(fixed.angles); }

std::unique_ptr<Mount> FixedKind::open() const { return std::make_unique<FixedMount>(fixed); }

}  // namespace ols::mount
