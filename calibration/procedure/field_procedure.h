// A complete calibration procedure. Runs its stages in order, then asks a person what to do with
// the result. The caller carries out the orders, runs the adjustment when the stages are complete,
// and stores the result. Pure.
#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "calibration/procedure/stage.h"

namespace ols::calibration {

// The result of an adjustment, as shown to a person.
struct AdjustedResult {
  bool failed = false;  // there is no result: contradictions, or no heading
  bool good = false;    // the result is within the limits for acceptance
  std::string text;     // one screen
  std::string worst;    // the reference that should be sighted again; empty if none
};

enum class Outcome { kRunning, kAccepted, kKeptOld, kAborted };

class FieldProcedure {
 public:
  using Redo = std::function<void(const std::string& reference)>;
  // `redo`: called when the person wants one reference to be sighted again; this function must make
  // the last stage sight the reference again.
  FieldProcedure(std::vector<std::unique_ptr<Stage>> stages, Redo redo);

  // The current order. nullopt if the stages are complete and adjusted() must be called next, or if
  // the procedure has ended.
  std::optional<Order> next();
  void taken(const Taken& picture) { stage().taken(picture); }
  void seen(const Taken& picture) { stage().seen(picture); }
  bool work() { return stage().work(); }
  void not_taken(const std::string& why) { stage().not_taken(why); }
  void answered(const Answer& answer);
  void resumed() { stage().resumed(); }
  bool wants_adjustment() const { return outcome_ == Outcome::kRunning && !result_; }
  void adjusted(const AdjustedResult& result) { result_ = result; }
  void abort() { outcome_ = Outcome::kAborted; }

  Outcome outcome() const { return outcome_; }
  double progress() const;
  std::vector<Observation> observations() const;
  std::vector<std::string> take_remarks();

 private:
  Stage& stage() { return *stages_[std::min(at_, stages_.size() - 1)]; }
  Order decision() const;

  std::vector<std::unique_ptr<Stage>> stages_;
  Redo redo_;
  std::size_t at_ = 0;
  std::optional<AdjustedResult> result_;
  Outcome outcome_ = Outcome::kRunning;
};

}  // namespace ols::calibration
