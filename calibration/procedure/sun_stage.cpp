#include "calibration/procedure/sun_stage.h"

#include <array>
#include <cmath>

#include "calibration/guidance.h"
#include "calibration/pictures/sun_disc.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

constexpr double kBeside_deg = 10.0;
// Where in the picture the sun is put, in shares of its half size, and from which sides.
struct Aim {
  double right, down;
  int approach_pan, approach_tilt;
};
constexpr std::array<Aim, 8> kAims{{{0.0, 0.0, 1, 1},
                                    {-0.4, -0.4, -1, 1},
                                    {0.4, -0.4, 1, -1},
                                    {0.4, 0.4, -1, -1},
                                    {-0.4, 0.4, 1, 1},
                                    {0.0, -0.4, -1, 1},
                                    {0.0, 0.4, 1, -1},
                                    {0.0, 0.0, -1, -1}}};

PanTilt angles_of(const StationModel& model, const UnitReading& reading) {
  return {reading.pan.counts * 2.0 * kPi / static_cast<double>(model.pan.counts_per_turn),
          reading.tilt.counts * 2.0 * kPi / static_cast<double>(model.tilt.counts_per_turn)};
}

}  // namespace

SunStage::SunStage(const StationModel& model, std::shared_ptr<SunKeepOut> keep_out, MayGo may_go)
    : model_(model), keep_out_(std::move(keep_out)), may_go_(std::move(may_go)) {
  ask_filter("");
}

void SunStage::ask_filter(const std::string& trouble) {
  step_ = Step::kAskFilter;
  question_ = {};
  question_.text =
      (trouble.empty() ? "" : trouble + ". ") +
      "Put the sun filter on the lens, then confirm. Until a picture beside the sun is "
      "black the unit keeps away from the sun.";
  question_.choices = {"filter_on", "skip"};
}

// The middle of the picture at the sun, or beside it.
std::optional<Shot> SunStage::at_sun() const {
  const Aim& aim = kAims[at_];
  const CameraIntrinsics& camera = model_.geometry.camera;
  const Eigen::Vector2d half(0.5 * (camera.width_px - 1), 0.5 * (camera.height_px - 1));
  const Eigen::Vector2d pixel(half.x() * (1.0 + aim.right), half.y() * (1.0 + aim.down));
  const auto reading = reading_towards(model_, {keep_out_->sun_enu(), 0.0}, pixel, aim.approach_pan,
                                       aim.approach_tilt);
  if (!reading) return std::nullopt;
  Shot shot;
  shot.angles = angles_of(model_, *reading);
  shot.angles.pan_rad += turned_.pan_rad;
  shot.angles.tilt_rad += turned_.tilt_rad;
  shot.approach_pan = aim.approach_pan;
  shot.approach_tilt = aim.approach_tilt;
  if (!may_go_(shot.angles)) return std::nullopt;
  return shot;
}

std::optional<Shot> SunStage::beside() const {
  const AzimuthElevation sun = azimuth_elevation_from_enu(keep_out_->sun_enu());
  for (const int side : {1, -1}) {
    const double turn_rad = side * radians(kBeside_deg) / std::cos(sun.elevation_rad);
    const auto there = aim_along(model_.geometry, {sun.azimuth_rad + turn_rad, sun.elevation_rad});
    if (!there || !may_go_(*there)) continue;
    Shot shot;
    shot.angles = *there;
    return shot;
  }
  return std::nullopt;
}

// In words why the sun cannot be sighted now; empty: it can.
std::string SunStage::hindrance() const {
  const double elevation_deg = degrees(std::asin(keep_out_->sun_enu().z()));
  const bool low = elevation_deg < kLeastElevation_deg;
  if (!low && at_sun() && beside()) return {};
  return "it stands " + std::to_string(std::lround(elevation_deg)) + " degrees high: " +
         (low ? "below 10 the refraction is not known well enough"
              : "the unit cannot look there, or not beside it");
}

std::optional<Order> SunStage::next() {
  if (step_ == Step::kDone) return std::nullopt;
  if (step_ == Step::kAskFilter) {
    const std::string why = hindrance();
    if (!why.empty()) {
      give_up(why);
      return next();
    }
  }
  Order order;
  order.step = "sun";
  const bool asks = step_ == Step::kAskFilter || step_ == Step::kAskTurn || step_ == Step::kAskOff;
  if (asks) {
    order.kind = Order::Kind::kAsk;
    order.question = question_;
    return order;
  }
  const auto shot = step_ == Step::kSight ? at_sun() : beside();
  order.step = step_ == Step::kProve   ? "sun: a picture beside it, to prove the filter"
               : step_ == Step::kLeave ? "sun: away from it"
                                       : "sun, picture " + std::to_string(at_ + 1) + " of " +
                                             std::to_string(kAims.size());
  if (!shot) {  // it has risen or set out of the unit's travel
    not_taken("the unit cannot look there");
    return next();
  }
  order.shot = *shot;
  return order;
}

void SunStage::taken(const Taken& picture) {
  if (step_ == Step::kProve) {
    if (!is_black(picture.gray)) {
      return ask_filter("The picture 10 degrees beside the sun is not black: no filter is on");
    }
    keep_out_->lift();
    step_ = Step::kSight;
    return;
  }
  if (step_ == Step::kLeave) return ask_off(true);
  const SunDisc disc = find_sun(picture.gray, model_.geometry.camera.fx_px);
  if (disc) {
    observations_.push_back(observation_of(Kind::kSun, picture, disc.centre_px, disc.sd_px, "sun"));
    return next_sighting();
  }
  if (!observations_.empty()) {
    remark("sun: picture " + std::to_string(at_ + 1) + ": " + to_string(disc.refusal));
    return next_sighting();
  }
  step_ = Step::kAskTurn;
  question_ = {};
  question_.text = std::string("The sun is not found: ") + to_string(disc.refusal) +
                   ". Turn the unit until it is in the picture, or look again.";
  question_.choices = {"again", "turn", "skip"};
  question_.picture = picture.gray;
}

void SunStage::not_taken(const std::string& why) {
  if (step_ == Step::kProve) {
    give_up("the picture beside it is missing: " + why);
  } else if (step_ == Step::kLeave) {
    ask_off(false);
  } else {
    remark("sun: picture " + std::to_string(at_ + 1) + " is missing: " + why);
    next_sighting();
  }
}

void SunStage::next_sighting() {
  if (++at_ < kAims.size()) return;
  at_ = 0;
  step_ = Step::kLeave;
}

// What was sighted of it before stands: each sighting has its own time.
void SunStage::give_up(const std::string& why) {
  remark(observations_.empty()
             ? "sun: left out: " + why
             : "sun: no more pictures than " + std::to_string(observations_.size()) + ": " + why);
  step_ = Step::kDone;
  if (!filter_is_on_) return;
  // The unit may still look there: not before it has turned away does the filter come off.
  step_ = Step::kLeave;
  if (keep_out_->sun_enu().z() < 0.0) ask_off(true);
}

void SunStage::ask_off(bool looks_away) {
  step_ = Step::kAskOff;
  question_ = {};
  question_.text = looks_away ? "Take the sun filter off the lens, then confirm."
                              : "The unit could not be turned away from the sun: cover the lens "
                                "before you take the sun filter off, then confirm.";
  question_.choices = {"filter_off"};
}

void SunStage::answered(const Answer& answer) {
  if (step_ == Step::kAskFilter && answer.choice == "filter_on") {
    filter_is_on_ = true;
    step_ = Step::kProve;
  } else if (step_ == Step::kAskFilter && answer.choice == "skip") {
    give_up("skipped");
  } else if (step_ == Step::kAskTurn && answer.choice == "turn") {
    turned_.pan_rad += answer.turn.pan_rad;
    turned_.tilt_rad += answer.turn.tilt_rad;
    step_ = Step::kSight;
  } else if (step_ == Step::kAskTurn && answer.choice == "again") {
    step_ = Step::kSight;
  } else if (step_ == Step::kAskTurn && answer.choice == "skip") {
    remark("sun: left out: skipped");
    at_ = 0;
    step_ = Step::kLeave;
  } else if (step_ == Step::kAskOff && answer.choice == "filter_off") {
    keep_out_->restore();
    filter_is_on_ = false;
    step_ = Step::kDone;
  }
}

void SunStage::resumed() {
  const bool looks = step_ == Step::kProve || step_ == Step::kSight || step_ == Step::kAskTurn;
  if (looks) ask_filter("The procedure was interrupted");
  keep_out_->restore();
}

double SunStage::progress() const {
  if (step_ == Step::kDone) return 1.0;
  const bool over = step_ == Step::kLeave || step_ == Step::kAskOff;
  return over ? 0.95 : 0.9 * static_cast<double>(at_) / static_cast<double>(kAims.size());
}

}  // namespace ols::calibration
