#include "edge/calibration/instrument_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iomanip>
#include <sstream>

#include "base/config/config_section.h"
#include "base/config/toml_text.h"
#include "edge/calibration/covariance_file.h"
#include "edge/config/config_units.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

// 1-sigma of each coefficient of a fisheye or polynomial that nobody has calibrated.
constexpr double kWideSd = 0.02;
constexpr double kLeastFocal = 1e-3;  // of the focal length [px], and of the aspect

// Numbers of instrument.toml, in the units of the file.
struct Numbers {
  std::array<double, kInstrumentParameters> values{}, sds{};
};

config::Section numbers_section(const std::string& name, const std::string& sentence,
                                std::array<double, kInstrumentParameters>& numbers, double least) {
  config::Section section{name, sentence};
  for (int i = 0; i < kInstrumentParameters; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const ParameterText& text = parameter_texts()[k];
    // A camera without a focal length images nothing; a deviation of 0 is a value that is known.
    const bool is_positive = i == kFocal || i == kAspect;
    const double from = is_positive && least < 0.0 ? kLeastFocal : least;
    section.rows.push_back(config::number(text.key, numbers[k], {from, 1e7}, "", text.sentence));
  }
  return section;
}

config::Section unit_section(Instrument& instrument) {
  constexpr std::int64_t kMostCounts = 100'000'000;
  return {"unit",
          "The pan-tilt unit.",
          {config::integer("pan_counts_per_turn", instrument.pan.counts_per_turn, 100, kMostCounts,
                           "", "Counts of a whole turn of pan: exact."),
           config::integer("tilt_counts_per_turn", instrument.tilt.counts_per_turn, 100,
                           kMostCounts, "", "Counts of a whole turn of tilt: exact."),
           config::integer("pan_worm_teeth", instrument.pan.worm_teeth, 1, 10000, "",
                           "Turns of the pan worm in a turn of pan."),
           config::integer("tilt_worm_teeth", instrument.tilt.worm_teeth, 1, 10000, "",
                           "Turns of the tilt worm in a turn of tilt."),
           // An angle without any error would have an infinite weight.
           config::number("angle_sd_deg", instrument.angle_sd_rad, {1e-7, 1.0},
                          station::in_degrees(), "1-sigma of each angle, new with every pose."),
           config::one_of("pan_sign", instrument.fixed.pan_sign, {1, -1}, "",
                          "1: the unit counts pan to the left, -1: to the right."),
           config::one_of("tilt_sign", instrument.fixed.tilt_sign, {1, -1}, "",
                          "1: the unit counts tilt upwards, -1: downwards."),
           config::number("pan_zero_deg", instrument.fixed.pan_zero_rad, {-360.0, 360.0},
                          station::in_degrees(), "Shaft angle of pan at zero counts."),
           config::number("tilt_zero_deg", instrument.fixed.tilt_zero_rad, {-360.0, 360.0},
                          station::in_degrees(), "Shaft angle of tilt at zero counts.")}};
}

config::Section lens_section(FixedValues& fixed, Numbers& numbers) {
  return {"lens",
          "Of the lens, what no adjustment changes.",
          {config::word("model", fixed.model, station::lens_model_words(),
                        "As in the station's configuration."),
           config::number("skew", fixed.skew, {-1e5, 1e5}, "px", "Skew of the pixel axes."),
           config::number("p1", fixed.p1, {-1e3, 1e3}, "", "Tangential distortion."),
           config::number("p2", fixed.p2, {-1e3, 1e3}, "", "Tangential distortion."),
           // Older files have it here; [values] is read after it.
           config::number("k3", numbers.values[kK3], {-1e9, 1e9}, "", "As in [values].")}};
}

config::Section serials_section(station::InstrumentSerials& serials) {
  return {"serials",
          "Serial numbers of its parts.",
          {config::text("camera", serials.camera, "Of the camera."),
           config::text("lens", serials.lens, "Of the lens."),
           config::text("ptu", serials.ptu, "Of the pan-tilt unit.")}};
}

config::Section instrument_section(Instrument& instrument, Numbers& numbers) {
  constexpr double kLeast = -1e7;
  return {"",
          "",
          {config::text("covariance", instrument.covariance_file,
                        "Covariance of the values, a CSV file beside this one; it replaces [sd].")},
          {serials_section(instrument.serials), unit_section(instrument),
           lens_section(instrument.fixed, numbers),
           numbers_section("values", "What was found.", numbers.values, kLeast),
           numbers_section("sd", "1-sigma of each value alone.", numbers.sds, 0.0)}};
}

Numbers numbers_of(const Instrument& instrument) {
  Numbers numbers;
  for (int i = 0; i < kInstrumentParameters; ++i) {
    const auto k = static_cast<std::size_t>(i);
    numbers.values[k] = to_file(i, instrument.values[i]);
    numbers.sds[k] = to_file(i, std::sqrt(instrument.covariance(i, i)));
  }
  return numbers;
}

// A camera that stands still has neither gears nor a stamp of counts, and its angles are constant.
void without_gears(const mount::Limits& limits, Instrument& instrument, InstrumentVector& sd) {
  constexpr double kAngleSd_rad = 1e-8;  // an angle without any error would have an infinite weight
  instrument.pan.counts_per_turn = std::llround(2.0 * kPi / limits.count.pan_rad);
  instrument.tilt.counts_per_turn = std::llround(2.0 * kPi / limits.count.tilt_rad);
  instrument.angle_sd_rad = kAngleSd_rad;
  sd.segment(kTrunnion, kExposureOffset + 1 - kTrunnion).setZero();
}

}  // namespace

Instrument new_instrument(const station::StationSettings& settings) {
  const StationGeometry& geometry = settings.station.geometry;
  Instrument instrument;
  instrument.serials = settings.serials;
  const CameraIntrinsics& camera = geometry.camera;
  const ChainParameters& chain = geometry.chain;
  instrument.fixed = {camera.model,   camera.skew,     camera.p1,          camera.p2,
                      chain.pan_sign, chain.tilt_sign, chain.pan_zero_rad, chain.tilt_zero_rad};
  instrument.values = instrument_of({.geometry = geometry, .pan = {}, .tilt = {}});
  InstrumentVector sd;
  for (int i = 0; i < kInstrumentParameters; ++i) {
    sd[i] = parameter_texts()[static_cast<std::size_t>(i)].new_unit_sd;
  }
  constexpr double kFocalShare = 0.003;
  sd[kFocal] = kFocalShare * geometry.camera.fx_px;
  if (camera.model != LensModel::kPinhole) {
    sd.segment<2>(kK1).setConstant(kWideSd);
    sd.segment<2>(kK3).setConstant(kWideSd);
  }
  sd[kMountZ] = std::max(sd[kMountZ], geometry.sd.mount_rad);
  sd[kMountY] = std::max(sd[kMountY], geometry.sd.mount_rad);
  sd[kMountX] = std::max(sd[kMountX], geometry.sd.mount_roll_rad);
  const station::StationConfig& station = settings.station;
  if (!station.moves) without_gears(station.limits, instrument, sd);
  instrument.covariance.diagonal() = sd.cwiseAbs2();
  return instrument;
}

Instrument read_instrument(const std::string& path, const Instrument& fallback) {
  Instrument instrument = fallback;
  Numbers numbers = numbers_of(fallback);
  ConfigFile file(path);
  config::read(instrument_section(instrument, numbers), file.root());
  check_plain(instrument.serials, path);
  if (instrument.fixed.model != fallback.fixed.model) {
    throw ConfigError(path + ": lens.model: is not that of the station's configuration");
  }
  for (int i = 0; i < kInstrumentParameters; ++i) {
    const auto k = static_cast<std::size_t>(i);
    instrument.values[i] = from_file(i, numbers.values[k]);
    instrument.covariance(i, i) = std::pow(from_file(i, numbers.sds[k]), 2);
  }
  if (!instrument.covariance_file.empty()) {
    const std::filesystem::path beside = std::filesystem::path(path).parent_path();
    instrument.covariance = read_covariance((beside / instrument.covariance_file).string());
  }
  return instrument;
}

void check_plain(const station::InstrumentSerials& serials, const std::string& path) {
  const auto check = [&path](const char* part, const std::string& serial) {
    const bool plain = std::ranges::none_of(
        serial, [](unsigned char c) { return c == '"' || c == '\\' || c < 0x20 || c == 0x7f; });
    if (plain) return;
    throw std::invalid_argument(path + ": serials." + part +
                                ": has a quote, a backslash or a control character");
  };
  check("camera", serials.camera);
  check("lens", serials.lens);
  check("ptu", serials.ptu);
}

void check_serials(const station::InstrumentSerials& configured,
                   const station::InstrumentSerials& calibrated, const std::string& path) {
  const auto check = [&path](const char* part, const std::string& here, const std::string& there) {
    if (here.empty() || there.empty() || here == there) return;
    throw std::invalid_argument(path + ": serials." + part + ": is of " + part + " '" + there +
                                "', the station has '" + here + "'");
  };
  check("camera", configured.camera, calibrated.camera);
  check("lens", configured.lens, calibrated.lens);
  check("ptu", configured.ptu, calibrated.ptu);
}

std::string uncompared_serials(const station::InstrumentSerials& configured,
                               const station::InstrumentSerials& calibrated) {
  std::string parts;
  const auto check = [&parts](const char* part, const std::string& here, const std::string& there) {
    if (here.empty() == there.empty()) return;
    parts += (parts.empty() ? "serials." : ", serials.") + std::string(part);
  };
  check("camera", configured.camera, calibrated.camera);
  check("lens", configured.lens, calibrated.lens);
  check("ptu", configured.ptu, calibrated.ptu);
  return parts;
}

StationModel with_instrument(const StationGeometry& geometry, const Instrument& instrument) {
  StationModel model;
  model.geometry = geometry;
  const FixedValues& fixed = instrument.fixed;
  CameraIntrinsics& camera = model.geometry.camera;
  ChainParameters& chain = model.geometry.chain;
  camera.model = fixed.model;
  camera.skew = fixed.skew;
  camera.p1 = fixed.p1;
  camera.p2 = fixed.p2;
  chain.pan_sign = fixed.pan_sign;
  chain.tilt_sign = fixed.tilt_sign;
  chain.pan_zero_rad = fixed.pan_zero_rad;
  chain.tilt_zero_rad = fixed.tilt_zero_rad;
  model.pan.counts_per_turn = instrument.pan.counts_per_turn;
  model.pan.worm_teeth = instrument.pan.worm_teeth;
  model.tilt.counts_per_turn = instrument.tilt.counts_per_turn;
  model.tilt.worm_teeth = instrument.tilt.worm_teeth;
  ModelParameters by = ModelParameters::Zero();
  by.head<kInstrumentParameters>() = instrument.values - instrument_of(model);
  return changed(model, by);
}

std::string instrument_text(const Instrument& instrument) {
  const FixedValues& fixed = instrument.fixed;
  std::ostringstream out;
  out << "# An instrument: camera, lens and pan-tilt unit together (docs/calibration.md).\n";
  if (!instrument.covariance_file.empty()) {
    out << "covariance = " << toml_text(instrument.covariance_file) << "\n";
  }
  out << "\n[serials]\ncamera = " << toml_text(instrument.serials.camera)
      << "\nlens = " << toml_text(instrument.serials.lens)
      << "\nptu = " << toml_text(instrument.serials.ptu) << "\n";
  out << "\n[unit]\npan_counts_per_turn = " << instrument.pan.counts_per_turn
      << "\ntilt_counts_per_turn = " << instrument.tilt.counts_per_turn
      << "\npan_worm_teeth = " << instrument.pan.worm_teeth
      << "\ntilt_worm_teeth = " << instrument.tilt.worm_teeth << std::setprecision(10)
      << "\nangle_sd_deg = " << degrees(instrument.angle_sd_rad)
      << "\npan_sign = " << fixed.pan_sign << "\ntilt_sign = " << fixed.tilt_sign
      << "\npan_zero_deg = " << degrees(fixed.pan_zero_rad)
      << "\ntilt_zero_deg = " << degrees(fixed.tilt_zero_rad) << "\n\n[lens]\nmodel = "
      << toml_text(kLensModelNames.at(static_cast<std::size_t>(fixed.model)))
      << "\nskew = " << fixed.skew << "\np1 = " << fixed.p1 << "\np2 = " << fixed.p2 << "\n";
  const Numbers numbers = numbers_of(instrument);
  for (const auto& [name, list] :
       {std::pair{"values", &numbers.values}, std::pair{"sd", &numbers.sds}}) {
    out << "\n[" << name << "]\n";
    for (std::size_t i = 0; i < list->size(); ++i) {
      out << parameter_texts()[i].key << " = " << (*list)[i] << '\n';
    }
  }
  return out.str();
}

}  // namespace ols::calibration
