// Sights the sun through a filter. A person puts the filter on, and a picture beside the sun
// confirms it. Only then does the unit look at the sun, with both directions of approach and at
// several places of the picture. Pure.
#pragma once

#include <memory>

#include "calibration/procedure/stage.h"
#include "calibration/procedure/sun_keep_out.h"

namespace ols::calibration {

// Whether the unit can be sent to these reported angles.
using MayGo = std::function<bool(const PanTilt&)>;

class SunStage : public Stage {
 public:
  // `keep_out`: suspended while the filter is on. `may_go`: whether travel and keep-out regions
  // allow a direction.
  SunStage(const StationModel& model, std::shared_ptr<SunKeepOut> keep_out, MayGo may_go);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer& answer) override;
  // Notes that the filter may have been taken off.
  void resumed() override;
  std::vector<Observation> observations() const override { return observations_; }
  double progress() const override;

 private:
  enum class Step { kAskFilter, kProve, kSight, kAskTurn, kLeave, kAskOff, kDone };

  std::optional<Shot> beside() const;
  std::optional<Shot> at_sun() const;
  void ask_filter(const std::string& trouble);
  void give_up(const std::string& why);
  void ask_off(bool looks_away);
  std::string hindrance() const;
  void next_sighting();

  StationModel model_;
  std::shared_ptr<SunKeepOut> keep_out_;
  MayGo may_go_;
  Step step_ = Step::kAskFilter;
  Question question_;
  bool filter_is_on_ = false;  // the person's last statement
  PanTilt turned_;             // by the person
  std::size_t at_ = 0;         // sighting
  std::vector<Observation> observations_;
};

}  // namespace ols::calibration
