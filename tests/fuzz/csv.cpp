// The offline formats. The first byte chooses: stations, bearings of two known stations, a
// trajectory, landmarks, a survey, sightings of two of its points.
#include <cmath>
#include <cstdlib>
#include <new>

#include "base/config/toml_config.h"
#include "base/files/csv_files.h"
#include "sim/world/trajectory_file.h"
#include "tests/fuzz/fuzz_input.h"

static void* large_buffer = nullptr;

// libfccp takes a buffer of 48 MB for every file: one for all of them, or the address sanitizer
// does little else than paint it.
void* operator new[](std::size_t bytes) {
  static constexpr std::size_t kLarge = std::size_t{3} << 24U;
  static char* const buffer = static_cast<char*>(std::malloc(kLarge));
  void* const memory = bytes == kLarge ? buffer : std::malloc(bytes);
  if (memory == nullptr) throw std::bad_alloc();
  large_buffer = buffer;
  return memory;
}
void operator delete[](void* memory) noexcept {
  if (memory != large_buffer) std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept { operator delete[](memory); }

namespace {

void stations(std::string_view content) {
  const ols::fuzz::MemoryFile file(content);
  for (const auto& row : ols::read_stations(file.path())) {
    ols::fuzz::require(!row.station.empty() && std::abs(row.latitude_deg) <= 90.0,
                       "a station stands on the Earth");
  }
}

void bearings(std::string_view content) {
  std::vector<ols::StationRow> known(2);
  known[0].station = "alfa";
  known[1].station = "bravo";
  const ols::fuzz::MemoryFile file(content);
  for (const auto& row : ols::read_bearings(file.path(), known)) {
    ols::fuzz::require(row.station == "alfa" || row.station == "bravo", "the station is known");
    ols::fuzz::require(std::isfinite(row.azimuth_deg) && row.sigma_deg > 0.0, "numbers are good");
  }
}

void trajectory(std::string_view content) {
  const ols::fuzz::MemoryFile file(content);
  const ols::LocalFrame site(ols::Geodetic{0.85, 0.29, 300.0});
  const auto path = ols::sim::load_trajectory_file(file.path(), site);
  ols::fuzz::require(path->at(1.0).p_enu.allFinite(), "a trajectory is finite");
}

void landmarks(std::string_view content) {
  const ols::fuzz::MemoryFile file(content);
  for (const auto& row : ols::read_landmarks(file.path())) {
    ols::fuzz::require(!row.object.empty() && row.distance_m > 0.0, "a landmark is somewhere");
    ols::fuzz::require(std::cos(row.alpha_rad) > 0.0 && std::abs(row.side) <= 1,
                       "a landmark is before the base");
    for (const auto& error_m : {row.estimated_m, row.measured_m}) {
      ols::fuzz::require(std::isfinite(error_m.value_or(0.0)), "errors are finite");
    }
  }
}

void survey(std::string_view content) {
  const ols::fuzz::MemoryFile file(content);
  for (const auto& row : ols::read_survey(file.path())) {
    ols::fuzz::require(!row.landmark.empty() && row.sd_m >= 0.0, "a point has a name and an error");
    const auto* utm = std::get_if<ols::UtmCells>(&row.place);
    ols::fuzz::require(utm == nullptr || (utm->zone >= 1 && utm->zone <= 60), "a zone exists");
  }
}

void sighted(std::string_view content) {
  std::vector<ols::SurveyRow> known(2);
  known[0].landmark = "tower";
  known[1].landmark = "mast";
  const ols::fuzz::MemoryFile file(content);
  for (const auto& row : ols::read_sighted(file.path(), known)) {
    ols::fuzz::require(std::isfinite(row.pan_deg) && std::isfinite(row.tilt_deg), "angles are");
    ols::fuzz::require(row.x_px.has_value() == row.y_px.has_value(), "a pixel is whole");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ols::fuzz::Input input(data, size);
  const std::uint8_t kind = input.byte();
  try {
    switch (kind % 6) {
      case 0:
        stations(input.rest());
        break;
      case 1:
        bearings(input.rest());
        break;
      case 2:
        trajectory(input.rest());
        break;
      case 3:
        landmarks(input.rest());
        break;
      case 4:
        survey(input.rest());
        break;
      default:
        sighted(input.rest());
    }
  } catch (const ols::CsvError&) {
    // Refused by name.
  } catch (const ols::ConfigError&) {
  }
  return 0;
}
