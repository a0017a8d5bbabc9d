#include "calibration/procedure/landmark_stage.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "calibration/procedure/learned_heading.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;

constexpr double kSnap_px = 8.0;  // around where it should be
constexpr double kFirstSnap_px = 16.0;
constexpr int kPatchHalf_px = 12;
constexpr double kFloor_px = 0.05;  // of a sighting

PanTilt plus(const PanTilt& a, const PanTilt& b) {
  return {a.pan_rad + b.pan_rad, a.tilt_rad + b.tilt_rad};
}

}  // namespace

LandmarkStage::LandmarkStage(const StationModel& model, std::vector<Landmark> landmarks, int rounds,
                             Adviser adviser)
    : model_(model), adviser_(std::move(adviser)) {
  for (Landmark& one : landmarks) {
    if (aim_at(model_.geometry, one.ecef)) {
      entries_.push_back({std::move(one), {}, {}, false});
    } else {
      remark(one.name + ": the unit cannot look there; it is left out");
    }
  }
  for (std::size_t i = 0; i < entries_.size(); ++i) visits_.push_back({i, 1, true, false});
  // Back and forth, each time from the other side of the gears.
  for (int round = 1; round < rounds; ++round) {
    const int approach = round % 2 == 0 ? 1 : -1;
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      const std::size_t e = round % 2 == 0 ? i : entries_.size() - 1 - i;
      visits_.push_back({e, approach, false, false});
    }
  }
  if (!entries_.empty()) visits_.push_back({0, 1, false, true});
}

Shot LandmarkStage::shot() const {
  const Entry& here = entries_[visit().entry];
  Shot shot;
  // Where the person confirmed it; before, where it should be.
  shot.angles = here.confirmed && !visit().by_person
                    ? here.confirmed->picture.angles
                    : aim_at(model_.geometry, here.landmark.ecef).value_or(PanTilt{});
  shot.angles = plus(shot.angles, turned_);
  shot.approach_pan = shot.approach_tilt = visit().approach;
  shot.is_view = true;
  return shot;
}

std::optional<Order> LandmarkStage::next() {
  const auto cannot_be_found = [this] {
    return !visit().by_person && (!entry().confirmed || entry().to_be_replaced);
  };
  while (at_ < visits_.size() && cannot_be_found()) next_visit();
  if (at_ >= visits_.size()) return std::nullopt;
  if (dialog_.question()) return dialog_.question();
  Order order;
  order.step = entry().landmark.name + ": " +
               (visit().closing     ? "back to the first, to close the round"
                : visit().by_person ? "driving there"
                                    : "once more, from the other side") +
               (advice_.empty() ? "" : "; " + advice_);
  order.shot = shot();
  return order;
}

std::optional<Vector2d> LandmarkStage::predicted(const Taken& picture) const {
  const auto seen = view(model_.geometry, corrected_angles(model_, picture.reading),
                         entries_[visit().entry].landmark.ecef);
  return seen ? std::optional(seen->pixel) : std::nullopt;
}

void LandmarkStage::taken(const Taken& picture) {
  if (!visit().by_person) return find_again(picture);
  dialog_.begin(entry().landmark.name, picture);
  // Where the chain expects it; before the heading is known, that is a guess with a wider reach.
  if (const auto place = predicted(picture)) {
    dialog_.place(*place, heading_known_ ? kSnap_px : kFirstSnap_px);
  }
}

void LandmarkStage::not_taken(const std::string& why) {
  remark(entry().landmark.name + ": no picture: " + why);
  next_visit();
}

void LandmarkStage::answered(const Answer& answer) {
  switch (dialog_.answered(answer)) {
    case PointingDialog::Event::kConfirmed:
      return confirm();
    case PointingDialog::Event::kTurn:
      turned_ = plus(turned_, answer.turn);
      return dialog_.end();
    case PointingDialog::Event::kSkipped:
      remark(entry().landmark.name + ": skipped");
      return next_visit();
    case PointingDialog::Event::kAsksOn:
      return;
  }
}

void LandmarkStage::confirm() {
  Confirmed confirmed;
  confirmed.picture = dialog_.picture();
  confirmed.pixel = dialog_.pixel();
  confirmed.sd_px = dialog_.sd_px();
  confirmed.patch = cut_patch(confirmed.picture.gray, confirmed.pixel, kPatchHalf_px);
  if (std::exchange(entry().to_be_replaced, false)) entry().sightings.clear();
  entry().sightings.push_back(observation_of(Kind::kLandmark, confirmed.picture, confirmed.pixel,
                                             confirmed.sd_px, entry().landmark.name));
  learn_heading(confirmed.picture, confirmed.pixel);
  confirmed.picture.gray.release();
  entry().confirmed = std::move(confirmed);
  close_here();
  next_visit();
}

// The round is closed at the first landmark that was sighted, whichever were skipped before it.
void LandmarkStage::close_here() {
  const bool is_first = std::ranges::count_if(entries_, [](const Entry& one) {
                          return one.confirmed.has_value();
                        }) == 1;
  const auto closing = std::ranges::find_if(visits_, &Visit::closing);
  if (is_first && closing != visits_.end()) closing->entry = visit().entry;
}

void LandmarkStage::learn_heading(const Taken& picture, const Vector2d& pixel) {
  const auto heading = learned_heading(model_, picture.reading, pixel, entry().landmark.ecef);
  if (!heading) return;
  model_.geometry.chain.heading_rad = *heading;
  heading_known_ = true;
}

void LandmarkStage::find_again(const Taken& picture) {
  constexpr double kReach_px = 20.0;
  const Confirmed& first = *entry().confirmed;
  PatchMatch match;
  match.refusal = PatchMatch::Refusal::kNoStructure;
  if (first.patch) match = find_patch(*first.patch, picture.gray, first.pixel, kReach_px);
  if (!match) {
    remark(entry().landmark.name + ": not found again by itself: " + to_string(match.refusal));
    return next_visit();
  }
  // The patch was cut where the person confirmed it: that error is in every sighting, as in the
  // first one.
  const double sd_px = std::hypot(first.sd_px, std::max(kFloor_px, match.sd_px));
  entry().sightings.push_back(
      observation_of(Kind::kLandmark, picture, match.centre_px, sd_px, entry().landmark.name));
  if (visit().closing) {
    const double px = (match.centre_px - first.pixel).norm();
    closing_rad_ = px / model_.geometry.camera.fx_px;
  }
  next_visit();
}

void LandmarkStage::next_visit() {
  ++at_;
  turned_ = {};
  dialog_.end();
  choose_next();
}

// Of those that the person has not seen yet the one comes first that helps most.
void LandmarkStage::choose_next() {
  advice_.clear();
  if (!adviser_ || !heading_known_) return;
  const auto begin = visits_.begin() + static_cast<std::ptrdiff_t>(at_);
  const auto end =
      std::find_if(begin, visits_.end(), [](const Visit& one) { return !one.by_person; });
  std::vector<Landmark> left;
  for (auto one = begin; one != end; ++one) left.push_back(entries_[one->entry].landmark);
  if (left.empty()) return;
  const std::vector<Foretold> ranked = adviser_(model_, left);
  const auto rank_of = [&](const Visit& one) {
    return std::ranges::find(ranked, entries_[one.entry].landmark.name, &Foretold::name) -
           ranked.begin();
  };
  std::stable_sort(begin, end,
                   [&](const Visit& a, const Visit& b) { return rank_of(a) < rank_of(b); });
  advice_ = in_words(ranked);
}

void LandmarkStage::redo(const std::string& name) {
  const auto found =
      std::ranges::find_if(entries_, [&](const Entry& one) { return one.landmark.name == name; });
  if (found == entries_.end()) return;
  found->to_be_replaced = true;
  const auto e = static_cast<std::size_t>(found - entries_.begin());
  at_ = visits_.size();
  visits_.push_back({e, 1, true, false});
  visits_.push_back({e, -1, false, false});
}

std::vector<Observation> LandmarkStage::observations() const {
  std::vector<Observation> all;
  for (const Entry& one : entries_) {
    all.insert(all.end(), one.sightings.begin(), one.sightings.end());
  }
  return all;
}

double LandmarkStage::progress() const {
  return visits_.empty() ? 1.0 : static_cast<double>(at_) / static_cast<double>(visits_.size());
}

}  // namespace ols::calibration
