#include "tools/calibrate/procedure_runner.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "base/process/clocks.h"
#include "base/process/shutdown.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

using M = ols_msg::procedure_t;

constexpr int kTurn_ms = 10;
constexpr double kPublish_s = 1.0;
constexpr double kPatience_s = 15.0;  // while nothing comes nearer
constexpr double kAskAgain_s = 3.0;   // a part was lost
constexpr double kSilent_s = 6.0;     // without a status the station is gone
constexpr double kWait_s = 0.1;       // before a stage that waits is asked again
constexpr double kLive_s = 0.7;       // from one picture of a live question to the next

// Makes the picture small enough for one datagram.
void add_picture(const Question& question, M& message) {
  constexpr std::size_t kMost_bytes = 55000;
  message.full_width_px = question.picture.cols;
  message.full_height_px = question.picture.rows;
  message.has_crosshair = question.crosshair_px ? 1 : 0;
  if (question.crosshair_px) {
    message.crosshair_px[0] = question.crosshair_px->x();
    message.crosshair_px[1] = question.crosshair_px->y();
    message.crosshair_sd_px = question.crosshair_sd_px;
  }
  for (const double width_px : {800.0, 640.0, 480.0, 320.0}) {
    if (question.picture.empty()) break;
    message.scale = std::min(1.0, width_px / question.picture.cols);
    cv::Mat small;
    cv::resize(question.picture, small, {}, message.scale, message.scale, cv::INTER_AREA);
    cv::imencode(".jpg", small, message.jpeg, {cv::IMWRITE_JPEG_QUALITY, 75});
    if (message.jpeg.size() < kMost_bytes) return;
  }
  message.jpeg.clear();
}

}  // namespace

void ProcedureRunner::publish() {
  published_s_ = clock_monotonic_s();
  state_.procedure = name_;
  state_.elapsed_s = published_s_ - began_s_;
  station_.publish(state_);
}

void ProcedureRunner::turn() {
  station_.handle(kTurn_ms);
  if (shutdown_requested()) aborted_ = true;
  if (station_.take_abort()) aborted_ = true;
  check_station();
  if (clock_monotonic_s() >= published_s_ + kPublish_s) publish();
}

void ProcedureRunner::check_station() const {
  station_.check_not_stopped();
  if (clock_monotonic_s() > station_.heard_s() + kSilent_s) {
    throw std::runtime_error("the station is silent: the network or the station is down");
  }
}

// A camera that came back with another window or binning has other pixels.
void ProcedureRunner::check_size(const cv::Mat& picture) {
  if (size_.empty()) size_ = picture.size();
  if (picture.size() == size_) return;
  const auto words = [](const cv::Size& s) {
    return std::to_string(s.width) + " x " + std::to_string(s.height);
  };
  throw std::runtime_error("the camera sends pictures of " + words(picture.size()) +
                           " px now, before of " + words(size_) + ": set it right, then --resume");
}

Outcome ProcedureRunner::run(FieldProcedure& procedure, const Adjust& adjust) {
  began_s_ = clock_monotonic_s();
  bool replays = session_ && session_->is_replaying();
  while (procedure.outcome() == Outcome::kRunning) {
    if (replays) replays = still_replays(procedure);
    ordered_utime_us_ = clock_utime_us();
    const auto order = procedure.next();
    state_ = {};
    state_.progress = procedure.progress();
    state_.step = order ? order->step : "adjusting";
    person_.progress(state_.step);
    publish();
    if (!order) {
      procedure.adjusted(adjust());
    } else if (order->kind == Order::Kind::kWait) {
      wait();
    } else if (replays) {
      replay(procedure, *order);
    } else if (order->kind == Order::Kind::kShoot) {
      shoot(procedure, *order);
    } else {
      ask(procedure, *order);
    }
    for (const std::string& sentence : procedure.take_remarks()) person_.tell("! " + sentence);
    if (session_) session_->write_observations(procedure.observations());
    if (aborted_) procedure.abort();
  }
  return procedure.outcome();
}

// Tells the procedure of each earlier interruption, and at the end of the replay of the present
// one.
bool ProcedureRunner::still_replays(FieldProcedure& procedure) {
  while (session_->take_resumed()) procedure.resumed();
  if (session_->is_replaying()) return true;
  session_->note({JournalEntry::Kind::kResumed, "", 0, "", {}});
  procedure.resumed();
  person_.tell("This is where it was interrupted; it goes on.");
  return false;
}

// Repeats what came of an order then, without carrying it out again.
void ProcedureRunner::replay(FieldProcedure& procedure, const Order& order) {
  turn();
  const JournalEntry entry = session_->replayed(order);
  switch (entry.kind) {
    case JournalEntry::Kind::kTaken:
      return procedure.taken(session_->stored(entry.pose));
    case JournalEntry::Kind::kNotTaken:
      return procedure.not_taken(entry.why);
    case JournalEntry::Kind::kAnswered:
      return procedure.answered(entry.answer);
    case JournalEntry::Kind::kResumed:
      return;
  }
}

// The position from which the last motion to the shot has the wanted direction in both axes.
PanTilt ProcedureRunner::before_approach(const Shot& shot) const {
  constexpr double kRunUp_rad = 0.007;  // 0.4 degrees: more than any backlash
  // If the side of approach is not known, the unit always runs up.
  const PanTilt here = here_ && sides_known_ ? *here_ : shot.angles;
  const auto from = [](double now, double to, int approach) {
    return (to - now) * approach >= kRunUp_rad ? to : to - approach * kRunUp_rad;
  };
  return {from(here.pan_rad, shot.angles.pan_rad, shot.approach_pan),
          from(here.tilt_rad, shot.angles.tilt_rad, shot.approach_tilt)};
}

std::optional<FrameFile> ProcedureRunner::picture_at(FieldProcedure& procedure,
                                                     const PanTilt& angles, Arrival arrival,
                                                     bool lossless) {
  station_.set_out(angles);
  std::optional<double> asked_s;
  while (!aborted_) {
    turn();
    if (auto frame = station_.take_frame()) {
      check_size(frame->taken.gray);
      return frame;
    }
    const double now_s = clock_monotonic_s();
    if (station_.is_refused_for_good()) break;
    if (now_s > station_.awaited().progress_s() + kPatience_s) break;
    // All messages of the meantime are handled first: a stop that has arrived must count.
    const bool due =
        !asked_s || now_s >= std::max(*asked_s, station_.awaited().part_heard_s()) + kAskAgain_s;
    if (!aborted_ && due && station_.may_point()) {
      station_.point();
      station_.ask_frame(arrival, lossless);
      asked_s = now_s;
    }
    procedure.work();
  }
  return std::nullopt;
}

std::optional<FrameFile> ProcedureRunner::picture_of(FieldProcedure& procedure, const Shot& shot) {
  if (shot.may_detour || !sides_known_) {
    const PanTilt first = before_approach(shot);
    const bool detour =
        first.pan_rad != shot.angles.pan_rad || first.tilt_rad != shot.angles.tilt_rad;
    if (detour && !picture_at(procedure, first, Arrival::kPasses, false)) return std::nullopt;
  }
  auto frame = picture_at(procedure, shot.angles, Arrival::kStands, shot.lossless);
  if (!frame) return std::nullopt;
  here_ = frame->taken.angles;
  const UnitReading& reading = frame->taken.reading;
  sides_known_ = reading.pan.approach != 0 && reading.tilt.approach != 0;
  return frame;
}

// A picture whose side of approach the station does not know is not used: the backlash is never
// guessed. The unit runs up once more; the station forgets the side when it homes.
void ProcedureRunner::shoot(FieldProcedure& procedure, const Order& order) {
  const std::string why = keep_away_ ? keep_away_(order.shot.angles) : "";
  if (!why.empty()) return miss(procedure, order, why);
  auto frame = picture_of(procedure, order.shot);
  if (frame && !sides_known_) frame = picture_of(procedure, order.shot);
  if (!frame) {
    const std::string& refusal = station_.refusal();
    return miss(procedure, order, refusal.empty() ? station_.awaited().missing() : refusal);
  }
  if (!sides_known_) {
    return miss(procedure, order, "the station does not know from which side the unit came");
  }
  Taken taken =
      session_ ? session_->add(std::move(*frame), order.shot.is_view) : std::move(frame->taken);
  note({JournalEntry::Kind::kTaken, order.step, taken.pose, "", {}});
  procedure.taken(taken);
}

// Notes the time of the order, too: the sun's place at that time decided what was ordered.
void ProcedureRunner::note(JournalEntry entry) {
  entry.ordered_utime_us = ordered_utime_us_;
  if (session_) session_->note(entry);
}

void ProcedureRunner::wait() {
  const double until_s = clock_monotonic_s() + kWait_s;
  while (!aborted_ && clock_monotonic_s() < until_s) turn();
}

void ProcedureRunner::miss(FieldProcedure& procedure, const Order& order, const std::string& why) {
  if (aborted_) return;
  note({JournalEntry::Kind::kNotTaken, order.step, 0, why, {}});
  procedure.not_taken(why);
}

void ProcedureRunner::show(const Question& question) {
  state_.text = question.text;
  state_.choice = question.choices;
  add_picture(question, state_);
  publish();
}

// A new picture for a live question updates what was asked.
void ProcedureRunner::keep_live(FieldProcedure& procedure, LiveQuestion& live) {
  const double now_s = clock_monotonic_s();
  if (const auto frame = station_.take_frame()) {
    check_size(frame->taken.gray);
    procedure.seen(frame->taken);
    live.due_s = now_s + kLive_s;
    const auto order = procedure.next();
    if (!order || order->kind != Order::Kind::kAsk) return;
    if (order->question.text != live.text) person_.ask_again(order->question);
    live.text = order->question.text;
    show(order->question);
    station_.set_out(*here_);
  }
  if (now_s < live.due_s || !station_.may_point()) return;
  station_.point();  // the lease of the unit is renewed
  station_.ask_frame(Arrival::kStands, false);
  live.due_s = now_s + kAskAgain_s;
}

// A question may wait for so long that the sun comes into the picture. The command is repeated
// until the unit stands elsewhere, because one may be lost.
void ProcedureRunner::turn_away() {
  const auto stands = station_.angles();
  const double now_s = clock_monotonic_s();
  if (!keep_away_ || !stands || now_s < turn_due_s_ || !station_.may_point()) return;
  turn_due_s_ = now_s + kPublish_s;
  const std::string why = keep_away_(*stands);
  if (why.empty()) return;
  for (const double deg : {15.0, -15.0, 30.0, -30.0, 60.0, -60.0}) {
    const PanTilt aside{stands->pan_rad + radians(deg), stands->tilt_rad};
    if (std::abs(aside.pan_rad) > kPi || !keep_away_(aside).empty()) continue;
    person_.tell("! the unit turns aside: " + why);
    here_ = aside;
    sides_known_ = false;
    station_.set_out(aside);
    return station_.point();
  }
}

void ProcedureRunner::ask(FieldProcedure& procedure, const Order& order) {
  state_.state = M::STATE_ASKING;
  state_.question = ++questions_;
  person_.ask(order.question);
  show(order.question);
  LiveQuestion live{clock_monotonic_s() + kLive_s, order.question.text};
  if (order.question.is_live && here_) station_.set_out(*here_);
  while (!aborted_) {
    turn();
    turn_away();
    if (order.question.is_live && here_) keep_live(procedure, live);
    auto answer = station_.take_answer(questions_);
    if (!answer) answer = person_.answer();
    if (!answer && person_.is_silent()) {
      person_.tell("the script has no more answers");
      answer = Answer{"abort", {}, {}};
    }
    if (answer) {
      answer->utime_us = clock_utime_us();
      aborted_ = answer->choice == "abort";
      if (!aborted_ && answer->choice != "accept" && answer->choice != "keep") {
        note({JournalEntry::Kind::kAnswered, order.step, 0, "", *answer});
      }
      return procedure.answered(*answer);
    }
  }
}

void ProcedureRunner::announce(std::int8_t state, const std::string& text) {
  state_ = {};
  state_.state = state;
  state_.text = text;
  state_.progress = 1.0;
  publish();
}

}  // namespace ols::calibration
