// Carries out a procedure's orders: drives the unit, takes pictures, asks the person at the
// terminal or at a console, and has the result computed.
#pragma once

#include <functional>
#include <opencv2/core.hpp>
#include <string>

#include "calibration/procedure/field_procedure.h"
#include "tools/calibrate/person.h"
#include "tools/calibrate/procedure_session.h"
#include "tools/calibrate/station_link.h"

namespace ols::calibration {

class ProcedureRunner {
 public:
  using Adjust = std::function<AdjustedResult()>;
  // `session`: null if nothing is stored.
  ProcedureRunner(std::string name, StationLink& station, Person& person, ProcedureSession* session)
      : name_(std::move(name)), station_(station), person_(person), session_(session) {}

  // Why the unit must not look at these reported angles now; empty: it may.
  using KeepAway = std::function<std::string(const PanTilt&)>;
  void keep_away(KeepAway why) { keep_away_ = std::move(why); }

  // Runs to the end. A resumed session first reports its earlier results again, without motion.
  // Throws StationStopped when the station is stopped or taken away, and std::runtime_error when it
  // is lost. SIGTERM and SIGINT abort.
  Outcome run(FieldProcedure& procedure, const Adjust& adjust);
  // The last message: how it ended.
  void announce(std::int8_t state, const std::string& text);

 private:
  void turn();  // messages, signals, and once a second the state
  void publish();
  bool still_replays(FieldProcedure& procedure);
  void replay(FieldProcedure& procedure, const Order& order);
  void shoot(FieldProcedure& procedure, const Order& order);
  void wait();
  void miss(FieldProcedure& procedure, const Order& order, const std::string& why);
  void note(JournalEntry entry);
  // Approached from the wanted side. nullopt: aborted, or not reached.
  std::optional<FrameFile> picture_of(FieldProcedure& procedure, const Shot& shot);
  // The same while the unit stands at these angles.
  std::optional<FrameFile> picture_at(FieldProcedure& procedure, const PanTilt& angles,
                                      Arrival arrival, bool lossless);
  PanTilt before_approach(const Shot& shot) const;
  // The content of a live question, and when the next picture is due (monotonic).
  struct LiveQuestion {
    double due_s = 0.0;
    std::string text;
  };
  void ask(FieldProcedure& procedure, const Order& order);
  void show(const Question& question);
  void keep_live(FieldProcedure& procedure, LiveQuestion& live);
  void turn_away();
  void check_station() const;
  void check_size(const cv::Mat& picture);

  std::string name_;
  StationLink& station_;
  Person& person_;
  ProcedureSession* session_;
  ols_msg::procedure_t state_{};
  double began_s_ = 0.0, published_s_ = 0.0;
  double turn_due_s_ = 0.0;            // next check whether the unit must turn away
  std::int64_t ordered_utime_us_ = 0;  // when the stage gave the order
  std::int64_t questions_ = 0;
  cv::Size size_;                // [px] of the first picture
  std::optional<PanTilt> here_;  // angles of the last picture
  bool sides_known_ = false;     // whether the last approach's direction is known
  KeepAway keep_away_;
  bool aborted_ = false;
};

}  // namespace ols::calibration
