#include "sim/lockstep/lockstep_operator.h"

#include <algorithm>
#include <cmath>

namespace ols::sim {
namespace {

constexpr double kBoot_s = 100.0;         // of the monotonic clock at the scenario's start
constexpr double kOperatorDelay_s = 0.3;  // delay of the operator's image
constexpr double kPointInterval_s = 2.0, kPointLead_s = 1.2;
constexpr double kStill_s = 0.1;   // an operator does not designate a target in a moving image
constexpr double kSettle_s = 1.5;  // from the PTU's readiness to the first designation
constexpr double kRemembered_s = 1.0;

}  // namespace

double monotonic_s(double time_s) { return kBoot_s + time_s; }

LockstepOperator::LockstepOperator(const World& world, std::size_t index, const Fidelity& fidelity,
                                   LockstepNoise& noise, const LockstepMount& mount,
                                   station::Station& station)
    : world_(world), index_(index), noise_(noise), mount_(mount), station_(station) {
  const std::string& id = world.stations()[index].id;
  // An overview station is driven from outside.
  leaves_alone_ = std::ranges::count(fidelity.not_designated, id) > 0 ||
                  world.scenario().stations[index].overview;
  const auto wrong = std::ranges::find(fidelity.misdesignated, id, &Misdesignation::station);
  if (wrong != fidelity.misdesignated.end()) wrong_ = *wrong;
  constexpr double kRoughly_rad = 0.3 * kPi / 180.0;
  aiming_error_.pan_rad = kRoughly_rad * (2.0 * noise.uniform() - 1.0);
  aiming_error_.tilt_rad = kRoughly_rad * (2.0 * noise.uniform() - 1.0);
}

void LockstepOperator::see(const Seen& seen) {
  seen_.push_back(seen);
  if (seen.exposure.mid_s - seen_.front().exposure.mid_s > kRemembered_s) seen_.pop_front();
}

void LockstepOperator::act(double time_s) {
  if (ready_s_ < 0.0) ready_s_ = time_s;
  if (leaves_alone_ || designated_) return;
  if (pointed_s_ < 0.0 || time_s - pointed_s_ > kPointInterval_s) point_roughly(time_s);
  if (time_s - ready_s_ > kSettle_s) designate_seen(time_s);
}

void LockstepOperator::point_roughly(double time_s) {
  const TargetTruth target = world_.target(0, time_s + kPointLead_s);
  auto angles = aim_at(world_.stations()[index_].nominal, target.p_ecef);
  if (!angles) return;
  angles->pan_rad += aiming_error_.pan_rad;
  angles->tilt_rad += aiming_error_.tilt_rad;
  station_.point({*angles}, monotonic_s(time_s));
  pointed_s_ = time_s;
}

bool LockstepOperator::stands_since(double from_s, double time_s) const {
  constexpr double kStanding_rad = 1e-3;
  const PanTilt then = mount_.angles_at(monotonic_s(from_s));
  const PanTilt now = mount_.angles_at(monotonic_s(time_s));
  return std::hypot(now.pan_rad - then.pan_rad, now.tilt_rad - then.tilt_rad) < kStanding_rad;
}

void LockstepOperator::designate_seen(double time_s) {
  constexpr double kMargin_px = 60.0;
  const auto frame = std::find_if(seen_.rbegin(), seen_.rend(), [&](const Seen& seen) {
    return time_s - seen.exposure.mid_s >= kOperatorDelay_s;
  });
  if (frame == seen_.rend() || !frame->view.visible || !seen_.back().view.visible) return;
  if (!stands_since(frame->exposure.mid_s - kStill_s, time_s)) return;
  const Eigen::Vector2d c = frame->view.centre_px;
  const CameraIntrinsics& camera = world_.stations()[index_].nominal.camera;
  if (c.x() < kMargin_px || c.y() < kMargin_px || c.x() > camera.width_px - kMargin_px ||
      c.y() > camera.height_px - kMargin_px) {
    return;
  }
  auto box = marked(*frame);
  if (!box) return;
  const double sd_px = world_.scenario().errors.designation.stated_sd_px();
  box->x += sd_px * noise_.gaussian();
  box->y += sd_px * noise_.gaussian();
  designated_ =
      station_.designate({frame->stamp_s, *box}, monotonic_s(time_s)) == station::Refusal::kNone;
}

// The target's box as this operator designates it; nullopt: it is not in the image.
std::optional<cv::Rect2d> LockstepOperator::marked(const Seen& seen) const {
  if (!wrong_) return seen.view.box;
  const ViewTruth view = view_truth(world_, index_, seen.exposure, wrong_->target);
  if (!view.visible) return std::nullopt;
  const cv::Rect2d& box = view.box;
  const double grown = 0.5 * (wrong_->scale - 1.0);
  return cv::Rect2d(box.x + wrong_->off_px.x() - grown * box.width,
                    box.y + wrong_->off_px.y() - grown * box.height, wrong_->scale * box.width,
                    wrong_->scale * box.height);
}

}  // namespace ols::sim
