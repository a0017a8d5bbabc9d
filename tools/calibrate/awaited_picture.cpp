#include "tools/calibrate/awaited_picture.h"

#include <cmath>

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::calibration {

void AwaitedPicture::hear_angles(const PanTilt& angles, double now_s) {
  constexpr double kNearer_rad = 1e-4;  // more than a standing unit's readings differ by
  if (!std::isfinite(angles.pan_rad) || !std::isfinite(angles.tilt_rad)) return;
  angles_ = angles;
  const double off_rad =
      std::max(std::abs(angles.pan_rad - at_.pan_rad), std::abs(angles.tilt_rad - at_.tilt_rad));
  if (off_rad > nearest_rad_ - kNearer_rad) return;
  nearest_rad_ = off_rad;
  progress_s_ = now_s;
}

std::optional<std::vector<std::uint8_t>> AwaitedPicture::hear_part(
    const ols_msg::frame_part_t& part, double now_s) {
  constexpr int kMostParts = 1000;
  if (part.request_boot_id != boot_id_ || part.request_sequence < first_request_) return {};
  if (part.parts < 1 || part.parts > kMostParts || part.part < 0 || part.part >= part.parts) {
    return {};
  }
  if (part.utime < frame_utime_us_) return {};
  if (part.utime != frame_utime_us_) parts_.clear();
  frame_utime_us_ = part.utime;
  parts_in_frame_ = static_cast<std::size_t>(part.parts);
  if (parts_.insert_or_assign(part.part, part.data).second) part_s_ = now_s;
  if (parts_.size() > most_parts_) {
    most_parts_ = parts_.size();
    progress_s_ = now_s;
  }
  if (parts_.size() < parts_in_frame_) return {};
  std::vector<std::uint8_t> file;
  for (const auto& [number, data] : parts_) file.insert(file.end(), data.begin(), data.end());
  parts_.clear();
  return file;
}

std::string AwaitedPicture::missing() const {
  if (!angles_) return "the unit did not arrive: its angles are not known";
  if (nearest_rad_ > kThere_rad) {
    return printed("the unit did not arrive at pan %.2f, tilt %.2f deg: it is at %.2f, %.2f deg",
                   degrees(at_.pan_rad), degrees(at_.tilt_rad), degrees(angles_->pan_rad),
                   degrees(angles_->tilt_rad));
  }
  if (parts_.empty()) return "the unit arrived, but no picture of it standing came";
  return printed("the picture came in part: %zu of %zu parts", parts_.size(), parts_in_frame_);
}

}  // namespace ols::calibration
