// Carries out a procedure's orders: drives the unit, takes pictures, asks the person at the
// terminal or at a console, and computes the result.
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
  // `session`: where results are stored; null: nowhere.
  ProcedureRunner(std::string name, StationLink& station, Person& person, ProcedureSession* session)
      : name_(std::move(name)), station_(station), person_(person), session_(session) {}

  // Returns why the unit must not point to these reported angles now (because of the sun); empty:
  // it may.
  using KeepAway = std::function<std::string(const PanTilt&)>;
  void keep_away(KeepAway why) { keep_away_ = std::move(why); }

  // Runs the procedure to its end. A resumed session first reports its earlier results again,
  // without motion. Throws StationStopped if a person stops the station or takes control of it, and
  // std::runtime_error if the station no longer answers. SIGTERM and SIGINT abort.
  Outcome run(FieldProcedure& procedure, const Adjust& adjust);
  // Publishes the last message: how the procedure ended.
  void announce(std::int8_t state, const std::string& text);

 private:
  void turn();  // handles messages and signals; publishes the state once a second
  void publish();
  bool still_replays(FieldProcedure& procedure);
  void replay(FieldProcedure& procedure, const Order& order);
  void shoot(FieldProcedure& procedure, const Order& order);
  void wait();
  void miss(FieldProcedure& procedure, const Order& order, const std::string& why);
  void note(JournalEntry entry);
  // Takes a picture after approaching its angles from the requested side. Nullopt: the procedure
  // was aborted, or the unit did not arrive.
  std::optional<FrameFile> picture_of(FieldProcedure& procedure, const Shot& shot);
  // Takes a picture at these angles.
  std::optional<FrameFile> picture_at(FieldProcedure& procedure, const PanTilt& angles,
                                      Arrival arrival, bool lossless);
  PanTilt before_approach(const Shot& shot) const;
  // The text of a question that is updated with new pictures, and when the next picture is due
  // (monotonic).
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
  double turn_due_s_ = 0.0;  // when to check next whether the unit must turn away from the sun
  std::int64_t ordered_utime_us_ = 0;  // when the stage gave the order
  std::int64_t questions_ = 0;
  cv::Size size_;                // [px] of the first picture
  std::optional<PanTilt> here_;  // angles of the last picture
  bool sides_known_ = false;     // whether the last picture states from which side the unit came
  KeepAway keep_away_;
  bool aborted_ = false;
};

}  // namespace ols::calibration
