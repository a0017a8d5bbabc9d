#include "console/messages_calibration.h"

#include "console/rounded.h"
#include "wire/station_status.h"

namespace ols::console {
namespace {

Json calibration(std::int8_t state, std::int64_t utime_us, double sd_rad) {
  constexpr int kArcsecTenths = 6;  // of a degree
  return {{"state", wire::calibration_name(state)},
          {"utime_us", utime_us > 0 ? Json(utime_us) : Json(nullptr)},
          {"sd_deg", rounded(degrees(sd_rad), kArcsecTenths)}};
}

}  // namespace

Json calibration_of(const ols_msg::station_status_t& s) {
  Json fields = calibration(s.calibration_state, s.calibration_utime, s.calibration_sd_rad);
  fields["id"] = number_text(s.calibration_id);
  return fields;
}

Json calibration_of(const ols_msg::fusion_status_t& f, std::size_t station) {
  return calibration(f.calibration_state[station], f.calibration_utime[station],
                     f.calibration_sd_rad[station]);
}

}  // namespace ols::console
