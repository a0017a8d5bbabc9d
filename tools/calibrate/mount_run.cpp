#include "tools/calibrate/mount_run.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "base/process/clocks.h"
#include "base/process/shutdown.h"
#include "calibration/procedure/preconditions.h"
#include "geometry/angles.h"
#include "geometry/lens.h"
#include "tools/calibrate/calibrate_case.h"

namespace ols::calibration {
namespace {

constexpr int kTurn_ms = 10;
constexpr double kPatience_s = 40.0, kFramePatience_s = 4.0;
constexpr double kPointAgain_s = 1.5, kRateAgain_s = 0.1;
constexpr double kArrived_rad = radians(0.5);  // more than such mounts scatter
constexpr double kStepOfView = 0.1;            // of a view, from picture to picture at rest
constexpr double kViewsPerSecond = 0.3, kFastest_rad_s = radians(10.0);
constexpr double kPicturesOfPass = 10.0;  // half of its way
constexpr double kTurns_s = 8.0;          // for the next picture's part of the way
constexpr int kPanSteps = 6, kTiltSteps = 3, kPasses = 2, kTries = 3;

double distance(const PanTilt& a, const PanTilt& b) {
  return std::hypot(a.pan_rad - b.pan_rad, a.tilt_rad - b.tilt_rad);
}

}  // namespace

MountRun::MountRun(const StationFiles& station, LcmBus& bus)
    : link_(bus, station.settings.id),
      model_(prior_of(station.settings, station.instrument, station.config).model),
      sun_(model_, clock_utime_us) {
  constexpr double kStatus_s = 5.0;
  const auto status = link_.status(kStatus_s);
  if (!status) throw std::runtime_error("no status of " + station.settings.id + " on the bus");
  const StationFacts facts = facts_of(*status);
  if (!facts.moves || !facts.limits_known)
    throw std::runtime_error("the mount does not turn, or does not report its angles");
  wait_until_it_stands();
  const auto view = field_of_view(model_.geometry.camera);
  axes_ = {{&PanTilt::pan_rad, view.x(), kPanSteps, status->pan_limits_rad[0],
            status->pan_limits_rad[1]},
           {&PanTilt::tilt_rad, view.y(), kTiltSteps, status->tilt_limits_rad[0],
            status->tilt_limits_rad[1]}};
}

// Home is where the mount stands: two statuses that follow each other agree.
void MountRun::wait_until_it_stands() {
  constexpr double kStands_rad = radians(0.05);
  const double end_s = clock_monotonic_s() + kPatience_s;
  std::optional<PanTilt> before;
  while (clock_monotonic_s() < end_s) {
    const auto here = link_.angles();
    if (here && before && distance(*here, *before) < kStands_rad) {
      home_ = *here;
      return;
    }
    before = here;
    link_.status(kFramePatience_s);
    link_.check_not_stopped();
  }
  throw std::runtime_error("the mount does not stand still");
}

void MountRun::turn() {
  link_.handle(kTurn_ms);
  link_.check_not_stopped();
  if (shutdown_requested()) throw std::runtime_error("interrupted");
}

PanTilt MountRun::at(const Axis& axis, double angle_rad) const {
  PanTilt place = home_;
  place.*axis.of = angle_rad;
  return place;
}

std::optional<FrameFile> MountRun::frame(Arrival arrival, double patience_s) {
  link_.set_out(link_.awaited().at());  // what was asked for before is not wanted any more
  link_.ask_frame(arrival, false);
  const double end_s = clock_monotonic_s() + patience_s;
  while (clock_monotonic_s() < end_s) {
    turn();
    if (auto frame = link_.take_frame()) return frame;
  }
  return std::nullopt;
}

void MountRun::add(const FrameFile& frame, const Axis& axis, bool moves) {
  const Taken& taken = frame.taken;
  seen_.push_back({{taken.gray, taken.angles, moves},
                   taken.reading,
                   link_.count().value_or(PanTilt{}),
                   axis.of});
}

void MountRun::rest_at(const PanTilt& place) {
  const std::string sun = sun_.hindrance(place);
  if (!sun.empty()) throw std::runtime_error(sun);
  link_.set_out(place);
  const double end_s = clock_monotonic_s() + kPatience_s;
  double pointed_s = -1e9;
  while (clock_monotonic_s() < end_s) {
    turn();
    if (link_.is_refused_for_good()) break;
    const auto here = link_.angles();
    if (here &&
        std::hypot(here->pan_rad - place.pan_rad, here->tilt_rad - place.tilt_rad) < kArrived_rad)
      return;
    if (clock_monotonic_s() < pointed_s + kPointAgain_s || !link_.may_point()) continue;
    link_.point();
    pointed_s = clock_monotonic_s();
  }
  throw std::runtime_error(link_.refusal().empty() ? "the mount does not get to where it is sent"
                                                   : link_.refusal());
}

// A status may be older than the picture.
void MountRun::take_at(const PanTilt& place, const Axis& axis) {
  for (int i = 0; i < kTries; ++i) {
    rest_at(place);
    const auto taken = frame(Arrival::kRests, kFramePatience_s);
    if (taken && distance(taken->taken.angles, place) < kArrived_rad) {
      add(*taken, axis, false);
      return;
    }
    link_.status(kFramePatience_s);
  }
}

// Turns there, and takes pictures on the way.
void MountRun::pass(const Axis& axis, const PanTilt& to, double rate_rad_s) {
  PanTilt rate;
  rate.*axis.of = rate_rad_s;
  const double end_s = clock_monotonic_s() + kPatience_s;
  // A picture whenever it has turned this far; a mount that stands gives none.
  const double apart_rad = std::abs(to.*axis.of - home_.*axis.of) / kPicturesOfPass + 1e-3;
  double sent_s = -1e9, asked_s = -1e9, turned_s = clock_monotonic_s();
  std::optional<double> pictured_rad;
  const auto is_beyond = [&](const PanTilt& here) {
    return (here.*axis.of - to.*axis.of) * rate_rad_s >= 0.0;
  };
  while (clock_monotonic_s() < end_s) {
    const double now_s = clock_monotonic_s();
    if (now_s > sent_s + kRateAgain_s) {
      link_.turn_at(rate);
      sent_s = now_s;
    }
    const auto now = link_.angles();
    const bool is_due =
        now && (!pictured_rad || std::abs((*now).*axis.of - *pictured_rad) >= apart_rad);
    if (is_due) turned_s = now_s;
    if (now_s > turned_s + kTurns_s)
      throw std::runtime_error("the mount does not turn at the ordered rate");
    if (is_due && now_s > asked_s + kFramePatience_s) {
      link_.set_out(to);
      link_.ask_frame(Arrival::kAnywhere, false);
      asked_s = now_s;
    }
    turn();
    const auto frame = link_.take_frame();
    if (frame) {
      add(*frame, axis, true);
      pictured_rad = frame->taken.angles.*axis.of;
      asked_s = -1e9;
    }
    const auto here = frame ? std::optional(frame->taken.angles) : link_.angles();
    if (here && is_beyond(*here)) break;
  }
  link_.turn_at({});
}

void MountRun::measure(const Axis& axis) {
  const double step_rad = kStepOfView * axis.view_rad, reach_rad = axis.steps * step_rad;
  const double room_rad = reach_rad + 2.0 * step_rad;
  if (axis.most_rad - axis.least_rad < 2.0 * room_rad) return;
  const double middle_rad =
      std::clamp(home_.*axis.of, axis.least_rad + room_rad, axis.most_rad - room_rad);
  // From the middle down, up, and back: neighbours share most of their view.
  std::vector<int> way;
  for (int i = 0; i > -axis.steps; --i) way.push_back(i);
  for (int i = -axis.steps; i < axis.steps; ++i) way.push_back(i);
  for (int i = axis.steps; i >= 0; --i) way.push_back(i);
  for (const int i : way) {
    take_at(at(axis, middle_rad + i * step_rad), axis);
  }
  const double rate_rad_s = std::min(kViewsPerSecond * axis.view_rad, kFastest_rad_s);
  const PanTilt down = at(axis, middle_rad - reach_rad - step_rad);
  const PanTilt up = at(axis, middle_rad + reach_rad + step_rad);
  rest_at(down);
  for (int i = 0; i < kPasses; ++i) {
    pass(axis, up, rate_rad_s);
    pass(axis, down, -rate_rad_s);
  }
  rest_at(at(axis, middle_rad));
}

MountResult MountRun::measure() {
  try {
    for (const Axis& axis : axes_) measure(axis);
  } catch (...) {
    link_.release();  // a unit that stays under manual operation would follow nobody
    throw;
  }
  link_.release();
  return {result_of(axes_.front()), result_of(axes_.back())};
}

AxisResult MountRun::result_of(const Axis& axis) const {
  std::vector<TurnedPicture> pictures;
  std::vector<const Seen*> of;
  for (const Seen& one : seen_) {
    if (one.axis != axis.of) continue;
    pictures.push_back(one.picture);
    of.push_back(&one);
  }
  const PictureAngles found = angles_of_pictures(model_.geometry, pictures);
  std::vector<MountReading> readings;
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!found.angles[i]) continue;
    const Seen& one = *of[i];
    const AxisReading& read = axis.of == &PanTilt::pan_rad ? one.reading.pan : one.reading.tilt;
    readings.push_back({pictures[i].reported.*axis.of, read.counts_per_s * one.count.*axis.of,
                        read.approach, (*found.angles[i]).*axis.of, pictures[i].moves});
  }
  return {fit_mount(readings), pictures.size(), readings.size()};
}

}  // namespace ols::calibration
