#include "calibration/procedure/pointing_dialog.h"

#include <algorithm>

#include "calibration/pictures/landmark_snap.h"

namespace ols::calibration {
namespace {

using Eigen::Vector2d;

constexpr double kPointed_px = 0.5;  // of a person's mark that nothing snaps to
constexpr double kSnap_px = 8.0;     // around a finger
constexpr double kFloor_px = 0.05;   // of a sighting

// The middle of a mark that is larger than the window is even: look wider before saying so.
Snap found_near(const cv::Mat& gray, const Vector2d& near_px, double radius_px) {
  constexpr double kWidest = 4.0;  // times the window
  Snap snap = snap_to_structure(gray, near_px, radius_px);
  for (double wider = 2.0; wider <= kWidest && snap.refusal == Snap::Refusal::kNoStructure;
       wider *= 2.0) {
    snap = snap_to_structure(gray, near_px, wider * radius_px);
  }
  return snap;
}

}  // namespace

void PointingDialog::begin(const std::string& what, const Taken& picture) {
  what_ = what;
  picture_ = picture;
  show("");
}

void PointingDialog::show(const std::string& trouble) {
  Order order;
  order.kind = Order::Kind::kAsk;
  order.step = what_ + ": where is it?";
  order.question.picture = picture_.gray;
  order.question.text = (trouble.empty() ? "" : trouble + ". ") + "Point at " + what_ +
                        "; or turn the unit, if it is not in the picture.";
  order.question.choices = {"point", "exactly", "turn", "skip"};
  question_ = order;
}

void PointingDialog::place(const Vector2d& near_px, double radius_px, bool as_is) {
  const Snap snap = found_near(picture_.gray, near_px, radius_px);
  if (!snap && !as_is) {
    return show(std::string("No crosshair: ") + to_string(snap.refusal));
  }
  Question& question = question_->question;
  question.crosshair_px = as_is ? near_px : snap.centre_px;
  question.crosshair_sd_px = as_is ? kPointed_px : std::max(kFloor_px, snap.sd_px);
  question.text = "Is the crosshair on " + what_ + "?";
  question.choices = {"confirm", "point", "exactly", "turn", "skip"};
}

PointingDialog::Event PointingDialog::answered(const Answer& answer) {
  if (!question_) return Event::kAsksOn;
  const cv::Rect picture({}, picture_.gray.size());
  const bool has_pixel =
      answer.pixel && answer.pixel->allFinite() &&
      picture.contains({static_cast<int>(answer.pixel->x()), static_cast<int>(answer.pixel->y())});
  if (answer.choice == "confirm" && has_crosshair()) return Event::kConfirmed;
  if (answer.choice == "turn") return Event::kTurn;
  if (answer.choice == "skip") return Event::kSkipped;
  if ((answer.choice == "point" || answer.choice == "exactly") && has_pixel) {
    place(*answer.pixel, kSnap_px, answer.choice == "exactly");
  } else {
    show("A pixel of the picture is needed");
  }
  return Event::kAsksOn;
}

}  // namespace ols::calibration
