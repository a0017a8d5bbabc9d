// The stage in which landmarks are sighted with the help of a person. The person points at the
// first landmark in a picture. The unit then turns to each of the other landmarks, the most helpful
// one first. At each, a crosshair snaps to the landmark, and the person confirms. A second round
// runs automatically, from the other direction of approach. At the end, the unit returns to the
// first landmark, to check that nothing has moved. Pure.
#pragma once

#include <string>
#include <vector>

#include "calibration/pictures/patch_matching.h"
#include "calibration/procedure/pointing_dialog.h"
#include "calibration/procedure/sighting_planner.h"
#include "calibration/procedure/stage.h"
#include "geometry/station_model.h"

namespace ols::calibration {

using Landmark = Place;

class LandmarkStage : public Stage {
 public:
  // `model`: the station as far as it is known. Its heading may have any value, because the first
  // sighting determines the heading. `rounds`: number of sightings of each landmark. Landmarks at
  // which the unit cannot look are left out, with a remark. `adviser`: ranks the landmarks after
  // the first one; if null, the given order is used.
  LandmarkStage(const StationModel& model, std::vector<Landmark> landmarks, int rounds,
                Adviser adviser = nullptr);

  std::optional<Order> next() override;
  void taken(const Taken& picture) override;
  void not_taken(const std::string& why) override;
  void answered(const Answer& answer) override;
  std::vector<Observation> observations() const override;
  double progress() const override;

  // How far the first landmark appears to have moved at the end [rad]; nullopt before the end.
  std::optional<double> closing_rad() const { return closing_rad_; }
  // Sights this landmark again, with the help of the person. The old sightings stay valid until the
  // person confirms the new one.
  void redo(const std::string& name);
  const StationModel& model() const { return model_; }

 private:
  // A person's confirmed sighting of a landmark.
  struct Confirmed {
    Taken picture;
    Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
    double sd_px = 0.0;
    std::optional<Patch> patch;
  };
  struct Entry {
    Landmark landmark;
    std::optional<Confirmed> confirmed;
    std::vector<Observation> sightings;
    bool to_be_replaced = false;  // the next confirmed sighting replaces these
  };
  struct Visit {
    std::size_t entry = 0;
    int approach = 1;
    bool by_person = true;  // false: the landmark is found again by its patch
    bool closing = false;
  };

  const Visit& visit() const { return visits_[at_]; }
  Entry& entry() { return entries_[visit().entry]; }
  Shot shot() const;
  std::optional<Eigen::Vector2d> predicted(const Taken& picture) const;
  void confirm();
  void close_here();
  void find_again(const Taken& picture);
  void learn_heading(const Taken& picture, const Eigen::Vector2d& pixel);
  void next_visit();
  void choose_next();

  StationModel model_;
  bool heading_known_ = false;
  std::vector<Entry> entries_;
  std::vector<Visit> visits_;
  std::size_t at_ = 0;
  PanTilt turned_;         // how far the person has turned the unit in this visit
  PointingDialog dialog_;  // for this visit
  Adviser adviser_;
  std::string advice_;  // for this visit
  std::optional<double> closing_rad_;
};

}  // namespace ols::calibration
