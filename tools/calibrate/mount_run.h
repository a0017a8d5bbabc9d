// Turns a station's mount while the camera sees still scenery, and compares the positions that the
// mount reports, at rest and in motion, with the pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/bus/lcm_bus.h"
#include "calibration/mount_fit.h"
#include "calibration/pictures/picture_angles.h"
#include "calibration/procedure/sun_keep_out.h"
#include "tools/calibrate/procedure_stages.h"
#include "tools/calibrate/station_link.h"

namespace ols::calibration {

struct AxisResult {
  std::optional<MountFit> fit;  // nullopt: too few pictures
  // Number of pictures, and of those whose scenery was recognised (`found`). Both are 0 if the axis
  // cannot move far enough.
  std::size_t pictures = 0, found = 0;
};
struct MountResult {
  AxisResult pan, tilt;
};

class MountRun {
 public:
  // `bus` must outlive this object. Throws std::runtime_error if the station does not answer or may
  // not turn.
  MountRun(const StationFiles& station, LcmBus& bus);

  // Measures around the unit's present position. Releases the unit at the end, even after an error.
  // Throws StationStopped or std::runtime_error.
  MountResult measure();

 private:
  struct Axis {
    double PanTilt::*of;
    double view_rad;  // the field of view along the axis
    int steps;        // number of steps to each side
    double least_rad, most_rad;
  };

  void wait_until_it_stands();
  void turn();
  void measure(const Axis& axis);
  PanTilt at(const Axis& axis, double angle_rad) const;
  void rest_at(const PanTilt& place);
  void take_at(const PanTilt& place, const Axis& axis);
  void pass(const Axis& axis, const PanTilt& to, double rate_rad_s);
  std::optional<FrameFile> frame(Arrival arrival, double patience_s);
  void add(const FrameFile& frame, const Axis& axis, bool moves);
  AxisResult result_of(const Axis& axis) const;

  StationLink link_;
  StationModel model_;
  SunKeepOut sun_;
  PanTilt home_;
  std::vector<Axis> axes_;
  struct Seen {
    TurnedPicture picture;
    UnitReading reading;
    PanTilt count;
    double PanTilt::*axis;
  };
  std::vector<Seen> seen_;
};

}  // namespace ols::calibration
