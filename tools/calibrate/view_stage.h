// Takes the views of a stored panorama again and reports what has changed, by the rules of a
// station's self-check (edge/calibration).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "calibration/procedure/stage.h"
#include "edge/calibration/drift_watch.h"
#include "geometry/station_model.h"
#include "tools/calibrate/stored_pictures.h"

namespace ols::calibration {

// Chooses up to six pictures of scenery from a calibration's folder (frames.jsonl), as far apart in
// pan as possible. Throws std::runtime_error naming file and line.
std::vector<StoredPicture> views_of(const std::filesystem::path& calibration);

class ViewStage : public Stage {
 public:
  // `angle_sd_rad`: 1-sigma of each angle of the unit at rest.
  ViewStage(std::vector<StoredPicture> views, const StationModel& model, double angle_sd_rad)
      : views_(std::move(views)), model_(model), angle_sd_rad_(angle_sd_rad) {}

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override { return {}; }
  double progress() const override;

  // At the end: whether enough views could be compared. stands(): whether the station has stayed in
  // place.
  bool is_conclusive() const { return is_conclusive_; }
  bool stands() const;
  std::string verdict() const;

 private:
  void step();
  void end_round();

  std::vector<StoredPicture> views_;
  StationModel model_;
  double angle_sd_rad_;
  std::size_t at_ = 0;
  bool again_ = false;  // in the second round, which confirms the first
  bool is_conclusive_ = false;
  std::vector<station::ViewOffset> offsets_;  // of this round
  station::DriftWatch watch_{{}, 0};
};

}  // namespace ols::calibration
