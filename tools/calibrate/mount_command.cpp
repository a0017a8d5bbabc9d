#include "tools/calibrate/mount_command.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>

#include "base/files/atomic_file.h"
#include "base/process/clocks.h"
#include "base/process/shutdown.h"
#include "base/trust/trust_options.h"
#include "edge/calibration/mount_record.h"
#include "geometry/angles.h"
#include "tools/calibrate/command_report.h"
#include "tools/calibrate/config_change.h"
#include "tools/calibrate/mount_run.h"
#include "tools/setup/flat_toml.h"

namespace ols::calibration {
namespace {

std::string said(const std::string& axis, const AxisResult& of) {
  if (!of.fit && of.pictures == 0) return axis + ": too little travel to measure it";
  if (!of.fit && 2 * of.found > of.pictures)
    return fmt::format(
        "{}: the scenery of {} of {} pictures is found again, but too few of them were taken at "
        "rest or in motion, or they do not agree with the positions: measure again while the "
        "computer and the network are idle",
        axis, of.found, of.pictures);
  if (!of.fit)
    return fmt::format(
        "{}: the scenery of {} of {} pictures is found again, too few: turn to something that "
        "stands still and has structure",
        axis, of.found, of.pictures);
  const MountFit& fit = *of.fit;
  return fmt::format(
      "{}: gain {:.4f} +- {:.4f}, positions {:.0f} +- {:.0f} ms {} than configured, backlash "
      "{:.3f} +- {:.3f} deg, positions +- {:.3f} deg ({} pictures at rest, {} in motion)",
      axis, fit.gain.value, fit.gain.sd, 1e3 * std::abs(fit.delay_s.value), 1e3 * fit.delay_s.sd,
      fit.delay_s.value < 0.0 ? "earlier" : "later", degrees(fit.backlash_rad.value),
      degrees(fit.backlash_rad.sd), degrees(fit.position_sd_rad), fit.rests, fit.moves);
}

void check(const MountResult& result) {
  if (!result.pan.fit && !result.tilt.fit) throw std::runtime_error("nothing could be measured");
  if (result.pan.fit && result.tilt.fit && have_different_delays(*result.pan.fit, *result.tilt.fit))
    throw std::runtime_error(
        "the delays of pan and tilt contradict each other, although both are reported at once: "
        "pictures came with wrong times. Measure again while the computer and the network are "
        "idle");
}

// Both axes are reported at once, so they have one delay.
Measured common_delay(const std::vector<const MountFit*>& fits) {
  double weights = 0.0, sum = 0.0, apart = 0.0;
  for (const MountFit* fit : fits) {
    const double weight = 1.0 / (fit->delay_s.sd * fit->delay_s.sd);
    weights += weight;
    sum += weight * fit->delay_s.value;
  }
  const double mean = sum / weights;
  for (const MountFit* fit : fits) apart = std::max(apart, std::abs(fit->delay_s.value - mean));
  return {mean, std::hypot(std::sqrt(1.0 / weights), apart)};
}

// A camera that counts the other way turns the other way, too.
void set_axis(setup::Values& values, const std::string& axis, const MountFit& fit) {
  const std::string gain = "mount." + axis + "_gain_deg", speed = "mount." + axis + "_speed_deg_s";
  set(values, gain, number_in(values, gain, 1.0) * fit.gain.value);
  if (fit.gain.value < 0.0) set(values, speed, -number_in(values, speed, 1.0));
}

setup::Values corrected(setup::Values values, const MountResult& result) {
  constexpr double kDelay_s = 0.05, kLeastSd_s = 1e-3, kLeastSd_deg = 1e-3;  // of a configuration
  std::vector<const MountFit*> fits;
  double position_sd_rad = 0.0;
  for (const auto& [axis, of] : {std::pair{"pan", &result.pan}, std::pair{"tilt", &result.tilt}}) {
    const auto& fit = of->fit;
    if (!fit) continue;
    fits.push_back(&*fit);
    set_axis(values, axis, *fit);
    // Backlash, an error of half of it to either side, cannot be told from noise.
    position_sd_rad =
        std::max(position_sd_rad, std::hypot(fit->position_sd_rad, 0.5 * fit->backlash_rad.value));
  }
  const Measured delay = common_delay(fits);
  // A negative delay: the configured delay of the pictures is too long.
  const double delay_s = number_in(values, "mount.delay_s", kDelay_s) + delay.value;
  const double short_s = std::max(0.0, -delay_s);
  if (short_s > 3.0 * delay.sd)
    std::printf("positions come %.0f ms before the pictures: delay_s of [camera] is too long\n",
                1e3 * short_s);
  set(values, "mount.delay_s", std::max(0.0, delay_s));
  set(values, "mount.delay_sd_s", std::max(std::hypot(delay.sd, short_s), kLeastSd_s));
  set(values, "mount.position_sd_deg", std::max(degrees(position_sd_rad), kLeastSd_deg));
  return values;
}

// Limits and keep-out regions are in the mount's angles, which a new gain moves.
void check_limits(const setup::Values& values, const MountResult& result) {
  constexpr double kSame = 0.01;
  const bool moves = std::ranges::any_of(
      std::array{&result.pan, &result.tilt},
      [](const AxisResult* of) { return of->fit && std::abs(of->fit->gain.value - 1.0) > kSame; });
  if (!moves) return;
  for (const auto& [key, value] : values) {
    if (key.starts_with("mount.keep_out") || key.ends_with("_min_deg") || key.ends_with("_max_deg"))
      throw std::runtime_error(key + " is in the mount's angles, which this gain moves: take it " +
                               "out, write, and set it anew");
  }
}

// For ols-doctor. The result stands although it may not be kept.
void keep(const std::filesystem::path& store, const MountResult& result, bool written) {
  try {
    std::filesystem::create_directories(store);
    AtomicFile file((store / station::kMountRecord).string());
    file.stream() << fmt::format(
        "{:%Y-%m-%d %H:%M} UTC, {}\n{}\n{}\n",
        fmt::gmtime(static_cast<std::time_t>(clock_utime_us() / 1'000'000)),
        written ? "written to the configuration" : "not written to the configuration",
        said("pan", result.pan), said("tilt", result.tilt));
    file.commit();
  } catch (const std::exception& problem) {
    std::fprintf(stderr, "the result is not kept for ols-doctor: %s\n", problem.what());
  }
}

}  // namespace

CLI::App* add_mount(CLI::App& app, MountOptions& o) {
  CLI::App* mount = app.add_subcommand(
      "mount",
      "Gain, sign, delay, backlash and scatter of an ONVIF camera's position reports, by its own "
      "pictures: turns it a little to all sides. Turn it to still scenery before.");
  add_station(*mount, o.station);
  add_state(*mount, o.state_folder);
  mount->add_option("--lcm-url", o.lcm_url, "bus of the site; else the station's")
      ->envname("LCM_DEFAULT_URL");
  trust::add_trust_options(*mount, o.trust);
  mount->add_flag("--write", o.write, "change [mount] of the station's configuration");
  return mount;
}

int run_mount(const MountOptions& o) {
  install_shutdown_handler();
  ProcedureOptions options;
  options.name = "mount";
  options.station = o.station;
  options.state_folder = o.state_folder;
  const StationFiles station = read_station(options);
  const std::string text = config_text(station.config);
  const setup::Values before = setup::flat(text);
  const std::string* kind = setup::find(before, "mount.kind");
  if (kind == nullptr || setup::text_in(*kind) != "onvif")
    throw std::invalid_argument(station.config + ": [mount] is not of the kind \"onvif\"");
  LcmBus bus(o.lcm_url.empty() ? station.settings.lcm_url : o.lcm_url,
             StationLink::open_trust(o.trust));
  const MountResult result = MountRun(station, bus).measure();
  std::printf("%s\n%s\n", said("pan", result.pan).c_str(), said("tilt", result.tilt).c_str());
  std::fflush(stdout);
  check(result);
  const setup::Values now = corrected(before, result);
  tell_changes(before, now);
  if (o.write) {
    check_limits(before, result);
    write_changes(station.config, text, before, now);
  }
  keep(station.store, result, o.write);
  return result.pan.fit && result.tilt.fit ? 0 : kExitLookAtIt;
}

}  // namespace ols::calibration
