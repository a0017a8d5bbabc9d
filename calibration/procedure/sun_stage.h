// The stage in which the sun is sighted through a filter. A person puts the filter on the lens. A
// picture beside the sun must then be black: this confirms the filter. Only then does the unit look
// at the sun, with both directions of approach, and with the sun at several places in the picture.
// Pure.
#pragma once

#include <memory>

#include "calibration/procedure/stage.h"
#include "calibration/procedure/sun_keep_out.h"

namespace ols::calibration {

// Whether the unit can be sent to these angles (as the unit reports them).
using MayGo = std::function<bool(const PanTilt&)>;

class SunStage : public Stage {
 public:
  // `keep_out`: suspended while the filter is on. `may_go`: whether travel limits and keep-out
  // regions allow a direction.
  SunStage(const StationModel& model, std::shared_ptr<SunKeepOut> keep_out, MayGo may_go);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer& answer) override;
  // Asks for the filter again: it may have been taken off in the meantime.
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
  bool filter_is_on_ = false;  // according to the person
  PanTilt turned_;             // how far the person has turned the unit
  std::size_t at_ = 0;         // index of the sighting
  std::vector<Observation> observations_;
};

}  // namespace ols::calibration
