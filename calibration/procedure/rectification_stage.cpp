#include "calibration/procedure/rectification_stage.h"

#include <cmath>
#include <utility>

namespace ols::calibration {

RectificationStage::RectificationStage(TargetReaderPtr reader, const PanTilt& start, int rounds)
    : reader_(std::move(reader)), angles_(start), rounds_(rounds) {}

// Each picture stands a little elsewhere: at one place the gears would be wrong by the same in all.
Shot RectificationStage::shot() const {
  constexpr double kStep_rad = 4e-4;
  Shot shot;
  shot.angles = angles_;
  if (state_ != State::kMeasuring) return shot;
  shot.may_detour = !reader_->holds_unit();
  if (!shot.may_detour) return shot;
  shot.approach_pan = shot.approach_tilt = taken_ % 2 == 0 ? 1 : -1;
  const double step = kStep_rad * (taken_ - 0.5 * (pictures() - 1));
  shot.angles.pan_rad += step;
  shot.angles.tilt_rad += 0.7 * step;
  return shot;
}

std::optional<Order> RectificationStage::next() {
  if (state_ == State::kDone) return std::nullopt;
  if (state_ == State::kPuttingUp && question_) return question_;
  Order order;
  order.shot = shot();
  order.step = state_ == State::kMeasuring
                   ? reader_->name() + ", picture " + std::to_string(taken_ + 1) + " of " +
                         std::to_string(pictures())
                   : reader_->name() + ": driving there";
  return order;
}

void RectificationStage::taken(const Taken& picture) {
  state_ == State::kMeasuring ? measure(picture) : look(picture);
}

void RectificationStage::seen(const Taken& picture) {
  if (state_ == State::kPuttingUp && question_) look(picture);
}

void RectificationStage::not_taken(const std::string& why) {
  if (state_ == State::kMeasuring) {
    remark(reader_->name() + ": no picture: " + why);
    if (++taken_ >= pictures()) end_measuring();
    return;
  }
  remark(reader_->name() + ": no picture: " + why + "; it is left out");
  state_ = State::kDone;
}

void RectificationStage::look(const Taken& picture) {
  picture_ = picture;
  reading_ = reader_->read(picture, pointed_);
  ask("");
}

void RectificationStage::ask(const std::string& trouble) {
  Order order;
  order.kind = Order::Kind::kAsk;
  order.step = reader_->name() + ": put it up";
  Question& question = order.question;
  question.is_live = true;
  question.picture = reading_->shown;
  question.crosshair_px = reading_->crosshair_px;
  question.crosshair_sd_px = reading_->crosshair_sd_px;
  const bool found = reading_->trouble.empty();
  question.text =
      (trouble.empty() ? "" : trouble + ". ") + reader_->instruction() + ".\n" +
      (found ? reader_->name() + ": " + reading_->number : "Not measured: " + reading_->trouble);
  if (found) question.choices.emplace_back("confirm");
  for (const char* choice : {"point", "turn", "skip"}) question.choices.emplace_back(choice);
  question_ = std::move(order);
}

void RectificationStage::answered(const Answer& answer) {
  if (!question_) return;
  if (answer.choice == "confirm" && reading_->trouble.empty()) {
    state_ = State::kMeasuring;
    angles_ = picture_->angles;
    taken_ = read_ = 0;
    observations_.clear();
    question_.reset();
  } else if (answer.choice == "point" && answer.pixel && answer.pixel->allFinite()) {
    pointed_ = answer.pixel;
    look(*picture_);
  } else if (answer.choice == "turn") {
    angles_.pan_rad += answer.turn.pan_rad;
    angles_.tilt_rad += answer.turn.tilt_rad;
    pointed_.reset();  // it is elsewhere in the next picture
    question_.reset();
  } else if (answer.choice == "skip") {
    remark(reader_->name() + ": skipped");
    state_ = State::kDone;
  } else {
    ask(answer.choice == "confirm" ? "There is nothing to confirm yet"
                                   : "A pixel of the picture is needed");
  }
}

void RectificationStage::measure(const Taken& picture) {
  const TargetReading reading = reader_->read(picture, pointed_);
  if (reading.trouble.empty()) {
    observations_.insert(observations_.end(), reading.observations.begin(),
                         reading.observations.end());
    ++read_;
    number_ = reading.number;
  } else {
    remark(reader_->name() + ", picture " + std::to_string(taken_ + 1) + ": " + reading.trouble);
  }
  picture_ = picture;
  reading_ = reading;
  if (++taken_ >= pictures()) end_measuring();
}

// What is lost in half of the pictures was not measured: it is put up again.
void RectificationStage::end_measuring() {
  if (2 * read_ > taken_) {
    state_ = State::kDone;
    remark(reader_->name() + ": " + number_ + "; read in " + std::to_string(read_) + " of " +
           std::to_string(taken_) + " pictures");
    return;
  }
  state_ = State::kPuttingUp;
  observations_.clear();
  ask("The target was lost in most of the pictures");
}

double RectificationStage::progress() const {
  if (state_ == State::kDone) return 1.0;
  return state_ == State::kMeasuring ? 0.5 + 0.5 * taken_ / pictures() : 0.0;
}

}  // namespace ols::calibration
