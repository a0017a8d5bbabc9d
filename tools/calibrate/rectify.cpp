#include "tools/calibrate/rectify.h"

#include <fstream>
#include <iterator>

#include "calibration/procedure/rectification_stage.h"
#include "tools/calibrate/target_file.h"

namespace ols::calibration {
namespace {

// What the station knows of its own level. The camera's roll and elevation are seen against the
// horizon; they are relative to the unit only as far as the unit is level.
std::vector<Observation> level_of(const ols_msg::station_status_t& status) {
  using M = ols_msg::station_status_t;
  constexpr double kReading_rad = 5e-6;
  if (status.tilt_source == M::POSE_NONE || !(status.tilt_sd_rad > 0.0)) return {};
  Observation level;
  level.kind = Kind::kInclinometer;
  level.tilt_rad = {status.tilt_x_rad, status.tilt_y_rad};
  level.tilt_sd_rad = kReading_rad;
  level.zero_sd_rad = status.tilt_sd_rad;
  return {level};
}

// A stage without orders: its observations were read before the first picture.
class ReadBefore : public Stage {
 public:
  explicit ReadBefore(std::vector<Observation> observations)
      : observations_(std::move(observations)) {}
  std::optional<Order> next() override { return std::nullopt; }
  void taken(const Taken&) override {}
  void not_taken(const std::string&) override {}
  void answered(const Answer&) override {}
  std::vector<Observation> observations() const override { return observations_; }
  double progress() const override { return 1.0; }

 private:
  std::vector<Observation> observations_;
};

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

Procedure make_rectification(const ProcedureOptions& options, const StationFiles& station,
                             StationLink& link, ProcedureSession& session) {
  Procedure procedure;
  procedure.options = options;
  procedure.session = &session;
  const StationModel model = prior_of(station.settings, station.instrument, station.config).model;
  const auto status = link.status(0.0);
  const PanTilt start{status->pan_rad, status->tilt_rad};
  std::vector<std::unique_ptr<Stage>> stages;
  stages.push_back(std::make_unique<ReadBefore>(level_of(*status)));
  for (TargetReaderPtr& reader : target_readers(model, read_targets(options.targets))) {
    stages.push_back(
        std::make_unique<RectificationStage>(std::move(reader), start, options.rounds));
  }
  procedure.field = std::make_unique<FieldProcedure>(std::move(stages), FieldProcedure::Redo());
  session.write("targets.toml", text_of(options.targets));
  procedure.files = files_of(options, station, session);
  return procedure;
}

}  // namespace ols::calibration
