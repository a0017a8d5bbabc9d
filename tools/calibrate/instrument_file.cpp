#include "tools/calibrate/instrument_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "base/config_section.h"
#include "base/csv_files.h"
#include "edge/config_units.h"
#include "geometry/angles.h"

namespace ols::calibration {
namespace {

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
    section.rows.push_back(config::number(text.key, numbers[k], {least, 1e7}, "", text.sentence));
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
           config::number("angle_sd_deg", instrument.angle_sd_rad, {0.0, 1.0},
                          station::in_degrees(), "1-sigma of each angle, new with every pose.")}};
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

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  std::string cell;
  while (std::getline(stream, cell, ',')) cells.push_back(cell);
  return cells;
}

// The instrument's part of a covariance file: names in the first row and column.
InstrumentMatrix read_covariance(const std::string& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw CsvError(path + ": cannot be read");
  const std::vector<std::string> names = cells_of(line);
  const auto index_of = [](const std::string& key) -> int {
    for (int i = 0; i < kInstrumentParameters; ++i) {
      if (key == parameter_texts()[static_cast<std::size_t>(i)].key) return i;
    }
    return -1;
  };
  InstrumentMatrix covariance = InstrumentMatrix::Zero();
  int rows = 0;
  for (unsigned number = 2; std::getline(file, line); ++number) {
    const std::vector<std::string> cells = cells_of(line);
    const std::string place = path + ":" + std::to_string(number) + ": ";
    if (cells.size() != names.size()) throw CsvError(place + "row: too few or too many columns");
    const int row = index_of(cells[0]);
    if (row < 0) continue;
    ++rows;
    for (std::size_t k = 1; k < cells.size(); ++k) {
      const int column = index_of(names[k]);
      if (column < 0) continue;
      try {
        covariance(row, column) = from_file(row, from_file(column, std::stod(cells[k])));
      } catch (const std::exception&) {
        throw CsvError(place + names[k] + ": '" + cells[k] + "' is not a number");
      }
    }
  }
  if (rows != kInstrumentParameters) throw CsvError(path + ": a parameter is missing");
  if (!covariance.allFinite() || !covariance.isApprox(covariance.transpose(), 1e-6)) {
    throw CsvError(path + ": is not a covariance");
  }
  return covariance;
}

}  // namespace

Instrument new_instrument(const station::StationSettings& settings) {
  const StationGeometry& geometry = settings.station.geometry;
  Instrument instrument;
  instrument.serials = settings.serials;
  instrument.values = instrument_of({.geometry = geometry, .pan = {}, .tilt = {}});
  InstrumentVector sd;
  for (int i = 0; i < kInstrumentParameters; ++i) {
    sd[i] = parameter_texts()[static_cast<std::size_t>(i)].new_unit_sd;
  }
  constexpr double kFocalShare = 0.003;
  sd[kFocal] = kFocalShare * geometry.camera.fx_px;
  sd[kMountZ] = std::max(sd[kMountZ], geometry.sd.mount_rad);
  sd[kMountY] = std::max(sd[kMountY], geometry.sd.mount_rad);
  sd[kMountX] = std::max(sd[kMountX], geometry.sd.mount_roll_rad);
  instrument.covariance.diagonal() = sd.cwiseAbs2();
  return instrument;
}

Instrument read_instrument(const std::string& path, const Instrument& fallback) {
  Instrument instrument = fallback;
  Numbers numbers = numbers_of(fallback);
  ConfigFile file(path);
  config::read(instrument_section(instrument, numbers), file.root());
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

StationModel with_instrument(const StationGeometry& geometry, const Instrument& instrument) {
  StationModel model;
  model.geometry = geometry;
  model.pan.counts_per_turn = instrument.pan.counts_per_turn;
  model.pan.worm_teeth = instrument.pan.worm_teeth;
  model.tilt.counts_per_turn = instrument.tilt.counts_per_turn;
  model.tilt.worm_teeth = instrument.tilt.worm_teeth;
  ModelParameters by = ModelParameters::Zero();
  by.head<kInstrumentParameters>() = instrument.values - instrument_of(model);
  return changed(model, by);
}

std::string instrument_text(const Instrument& instrument) {
  std::ostringstream out;
  out << "# An instrument: camera, lens and pan-tilt unit together (docs/calibration.md).\n";
  if (!instrument.covariance_file.empty()) {
    out << "covariance = \"" << instrument.covariance_file << "\"\n";
  }
  out << "\n[serials]\ncamera = \"" << instrument.serials.camera << "\"\nlens = \""
      << instrument.serials.lens << "\"\nptu = \"" << instrument.serials.ptu << "\"\n";
  out << "\n[unit]\npan_counts_per_turn = " << instrument.pan.counts_per_turn
      << "\ntilt_counts_per_turn = " << instrument.tilt.counts_per_turn
      << "\npan_worm_teeth = " << instrument.pan.worm_teeth
      << "\ntilt_worm_teeth = " << instrument.tilt.worm_teeth << std::setprecision(10)
      << "\nangle_sd_deg = " << degrees(instrument.angle_sd_rad) << "\n";
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
