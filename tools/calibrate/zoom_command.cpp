#include "tools/calibrate/zoom_command.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "base/bus/boot_id.h"
#include "base/files/atomic_file.h"
#include "base/files/output_check.h"
#include "base/process/clocks.h"
#include "base/process/shutdown.h"
#include "base/trust/trust_options.h"
#include "calibration/pictures/scene_tracks.h"
#include "calibration/procedure/sun_keep_out.h"
#include "calibration/zoom_fit.h"
#include "conditions/printed.h"
#include "tools/calibrate/calibrate_case.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/config_change.h"
#include "tools/calibrate/procedure_stages.h"
#include "tools/calibrate/station_link.h"
#include "wire/orders.h"

namespace ols::calibration {
namespace {

constexpr int kTurn_ms = 10;
constexpr double kPatience_s = 20.0;  // for the lens to arrive, for a picture
constexpr double kAskAgain_s = 3.0;
constexpr double kAtPosition = 0.01;  // of the zoom's travel
constexpr double kRunUp_rad = 0.009;  // more than any backlash
constexpr int kSteps = 3;             // to each side
constexpr double kStepOfView = 0.2;   // of the field of view, from picture to picture
constexpr double kLargestStep_rad = 0.07;

// One row of the table as it is in a configuration.
std::string text_of(const ZoomPoint& point) {
  const CameraIntrinsics& c = point.camera;
  return printed(
      "\n[[lens_motor.point]]\nposition = %.4f\nfocal_px = %.2f\nfocal_sd_px = %.2f\n"
      "cx_px = %.2f\ncy_px = %.2f\ncentre_sd_px = %.2f\nk1 = %.5f\nk2 = %.5f\n",
      point.position, c.fx_px, point.focal_sd_px, c.cx_px, c.cy_px, point.centre_sd_px, c.k1, c.k2);
}

class ZoomRun {
 public:
  ZoomRun(const StationFiles& station, LcmBus& bus)
      : station_(station),
        bus_(bus),
        link_(bus, station.settings.id),
        sender_(draw_boot_id()),
        table_(station.settings.lens.points),
        model_(prior_of(station.settings, station.instrument, station.config).model),
        sun_(model_, clock_utime_us) {}

  void begin() {
    const auto status = link_.status(kPatience_s / 4);
    if (!status) throw std::runtime_error("no status of " + station_.settings.id + " on the bus");
    if (!facts_of(*status).limits_known) {
      throw std::runtime_error("the unit's reference is missing: home it");
    }
    home_ = {status->pan_rad, status->tilt_rad};
    pan_limits_ = {status->pan_limits_rad[0], status->pan_limits_rad[1]};
  }
  void end() { link_.release(); }

  // nullopt: the reason has been printed.
  std::optional<ZoomPoint> measure(double position) {
    const auto arrived = move_lens(position);
    if (!arrived) return complain(position, "the lens does not get there");
    StationGeometry known = model_.geometry;
    const ZoomPoint before = table_.at(*arrived, 0.0);
    known.camera = before.camera;
    known.camera.width_px = model_.geometry.camera.width_px;
    known.camera.height_px = model_.geometry.camera.height_px;
    SceneTracks tracks(known);
    std::vector<PanTilt> angles;
    for (const PanTilt& at : poses(known)) {
      const auto taken = picture_at(at);
      if (!taken) return complain(position, link_.awaited().missing());
      tracks.add(taken->gray, taken->angles);
      angles.push_back(taken->angles);
    }
    ZoomFitOptions options;
    options.centre_sd_px = std::max(1.0, before.centre_sd_px);
    options.angle_sd_rad = angle_sd_rad();
    ZoomFit fit = fit_zoom(known, angles, pairs_of(tracks), options);
    if (!fit)
      return complain(position,
                      "too little of the scenery is found again: turn to "
                      "something that stands still and has structure");
    fit.point.position = *arrived;
    std::printf("zoom %.3f: focal length %.1f +- %.1f px (was %.1f), %d points, fit %.1f\n",
                *arrived, fit.point.camera.fx_px, fit.point.focal_sd_px, before.camera.fx_px,
                fit.used, fit.rms_sd);
    std::fflush(stdout);
    return fit.point;
  }

 private:
  std::nullopt_t complain(double position, const std::string& why) const {
    std::fprintf(stderr, "ols-calibrate: zoom %.3f: %s\n", position, why.c_str());
    return std::nullopt;
  }
  void turn() {
    link_.handle(kTurn_ms);
    link_.check_not_stopped();
    if (shutdown_requested()) throw std::runtime_error("interrupted");
  }
  // Returns the position where two statuses that follow each other agree.
  std::optional<double> move_lens(double position) {
    const double end_s = clock_monotonic_s() + kPatience_s;
    double sent_s = -1e9, before = std::numeric_limits<double>::quiet_NaN();
    while (clock_monotonic_s() < end_s) {
      if (clock_monotonic_s() > sent_s + kAskAgain_s) {
        wire::Order order{.station = station_.settings.id, .kind = wire::Kind::kLens};
        order.zoom = position;
        order.id = sender_.next_id();
        sender_.send(bus_, order, clock_utime_us());
        sent_s = clock_monotonic_s();
      }
      turn();
      const auto status = link_.status(1.0);
      const double now = status ? status->lens_position[0] : before;
      if (std::abs(now - position) < kAtPosition && std::abs(now - before) < 1e-3) return now;
      before = now;
    }
    return std::nullopt;
  }
  // From one side to the other: all are approached alike, so backlash does not matter.
  std::vector<PanTilt> poses(const StationGeometry& known) const {
    const double view_rad = field_of_view(known.camera).x();
    const double step_rad = std::min(kStepOfView * view_rad, kLargestStep_rad);
    const double reach_rad = kSteps * step_rad + 2.0 * kRunUp_rad;
    const double middle_rad =
        std::clamp(home_.pan_rad, pan_limits_.first + reach_rad, pan_limits_.second - reach_rad);
    std::vector<PanTilt> poses;
    for (int i = -kSteps; i <= kSteps; ++i) {
      poses.push_back({middle_rad + i * step_rad, home_.tilt_rad});
    }
    return poses;
  }
  std::optional<Taken> picture_at(const PanTilt& at) {
    const PanTilt before{at.pan_rad - kRunUp_rad, at.tilt_rad - kRunUp_rad};
    if (!frame_at(before, Arrival::kPasses)) return std::nullopt;
    return frame_at(at, Arrival::kStands);
  }
  std::optional<Taken> frame_at(const PanTilt& at, Arrival arrival) {
    const std::string sun = sun_.hindrance(at);
    if (!sun.empty()) throw std::runtime_error(sun);
    link_.set_out(at);
    std::optional<double> asked_s;
    while (!link_.is_refused_for_good() &&
           clock_monotonic_s() < link_.awaited().progress_s() + kPatience_s) {
      turn();
      if (auto frame = link_.take_frame()) return std::move(frame->taken);
      const bool due =
          !asked_s ||
          clock_monotonic_s() > std::max(*asked_s, link_.awaited().part_heard_s()) + kAskAgain_s;
      if (!due || !link_.may_point()) continue;
      link_.point();
      link_.ask_frame(arrival, false);  // compressed: enough for points, and fast
      asked_s = clock_monotonic_s();
    }
    return std::nullopt;
  }
  // A count's rounding, and as much again for the worm's error over a few degrees.
  double angle_sd_rad() const {
    const double count_rad = link_.count() ? link_.count()->pan_rad : 1e-4;
    return std::sqrt(2.0 / 12.0) * count_rad;
  }
  static std::vector<ZoomPair> pairs_of(const SceneTracks& tracks) {
    std::vector<ZoomPair> pairs;
    const auto all = tracks.sightings();
    for (const SceneSighting& one : all) {
      const auto first = std::ranges::find(all, one.track, &SceneSighting::track);
      if (first->picture == one.picture) continue;
      pairs.push_back({first->picture, one.picture, first->pixel, one.pixel,
                       std::hypot(first->sd_px, one.sd_px)});
    }
    return pairs;
  }

  const StationFiles& station_;
  LcmBus& bus_;
  StationLink link_;
  wire::OrderSender sender_;
  ZoomTable table_;
  StationModel model_;
  SunKeepOut sun_;
  PanTilt home_;
  std::pair<double, double> pan_limits_;
};

std::vector<ZoomPoint> measured(ZoomRun& run, int positions) {
  std::vector<ZoomPoint> points;
  for (int i = 0; i < positions; ++i) {
    const auto point = run.measure(static_cast<double>(i) / (positions - 1));
    if (point) points.push_back(*point);
  }
  return points;
}

}  // namespace

CLI::App* add_zoom(CLI::App& app, ZoomOptions& o) {
  CLI::App* zoom = app.add_subcommand(
      "zoom",
      "The table of a motorised zoom lens: drives it through its travel, and at each position the "
      "unit a little to both sides. Turn the station to still scenery before.");
  add_station(*zoom, o.station);
  add_state(*zoom, o.state_folder);
  zoom->add_option("--lcm-url", o.lcm_url, "bus of the site; else the station's")
      ->envname("LCM_DEFAULT_URL");
  trust::add_trust_options(*zoom, o.trust);
  zoom->add_option("--positions", o.positions, "positions of the zoom, from widest to longest")
      ->check(CLI::Range(2, 40))
      ->capture_default_str();
  zoom->add_option("--output", o.output, "TOML: the points of [lens_motor]")->required();
  return zoom;
}

int run_zoom(const ZoomOptions& o) {
  install_shutdown_handler();
  ProcedureOptions options;
  options.name = "zoom";
  options.station = o.station;
  options.state_folder = o.state_folder;
  const StationFiles station = read_station(options);
  if (station.settings.lens.device.empty()) {
    throw std::invalid_argument(station.config + ": has no [lens_motor]");
  }
  check_outputs({{"--station", station.config}}, {{"--output", o.output}});
  LcmBus bus(o.lcm_url.empty() ? station.settings.lcm_url : o.lcm_url,
             StationLink::open_trust(o.trust));
  ZoomRun run(station, bus);
  run.begin();
  std::vector<ZoomPoint> points;
  try {
    points = measured(run, o.positions);
  } catch (...) {
    run.end();  // a unit that stays under manual operation would follow nobody
    throw;
  }
  run.end();
  if (points.size() < 2) throw std::runtime_error("fewer than two positions could be measured");
  static_cast<void>(ZoomTable(points));  // rises, as a configuration demands
  std::string text = "# The zoom lens of " + station.settings.id +
                     ", measured by ols-calibrate zoom: these take the place of the points in\n# "
                     "its configuration.\n";
  for (const ZoomPoint& point : points) text += text_of(point);
  AtomicFile file(o.output);
  file.stream() << text;
  file.commit();
  std::printf("written: %s\n", o.output.c_str());
  return static_cast<int>(points.size()) == o.positions ? 0 : kExitLookAtIt;
}

}  // namespace ols::calibration
