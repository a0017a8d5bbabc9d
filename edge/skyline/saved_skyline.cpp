#include "edge/skyline/saved_skyline.h"

#include <charconv>
#include <cinttypes>
#include <cmath>
#include <locale>
#include <sstream>

#include "base/files/fnv1a.h"
#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::skyline {
namespace {

constexpr std::string_view kHead = "ols-skyline 1\n";
constexpr std::string_view kSum = "sum ";

std::string sum_line(std::string_view text) { return printed("sum %016" PRIx64 "\n", fnv1a(text)); }

// Whether the line has exactly these values, after `name` if it is not empty.
template <class... Values>
bool read_line(std::istream& lines, const char* name, Values&... values) {
  std::string line, word;
  if (!std::getline(lines, line)) return false;
  std::istringstream stream(line);
  stream.imbue(std::locale::classic());
  if (*name != '\0' && !(stream >> word && word == name)) return false;
  return (stream >> ... >> values) && !(stream >> word);
}

bool read_hex(std::istream& lines, const char* name, std::uint64_t& value) {
  constexpr int kHex = 16;
  std::string word;
  if (!read_line(lines, name, word)) return false;
  const auto [end, failed] = std::from_chars(word.data(), word.data() + word.size(), value, kHex);
  return failed == std::errc() && end == word.data() + word.size();
}

bool read_column(std::istream& lines, int after, land::SeenSkyline& crests, int& column) {
  double elevation_deg = 0.0, sd_deg = 0.0;
  land::SeenCrest crest;
  if (!read_line(lines, "", column, elevation_deg, sd_deg, crest.hides_from_m, crest.disagrees)) {
    return false;
  }
  crest.elevation_rad = radians(elevation_deg);
  crest.sd_rad = radians(sd_deg);
  const bool is_good = column > after && column < land::SeenSkyline::kColumns &&
                       std::abs(elevation_deg) <= 90.0 && sd_deg > 0.0 && sd_deg <= 90.0 &&
                       crest.hides_from_m >= 0.0 && crest.hides_from_m <= 1e6;
  if (is_good) crests.set(column, crest);
  return is_good;
}

}  // namespace

std::uint64_t chain_hash(const ChainParameters& chain) {
  std::string text;
  for (const double angle_rad : {chain.heading_rad, chain.tilt_x_rad, chain.tilt_y_rad,
                                 chain.trunnion_rad, chain.mount_z_rad, chain.mount_x_rad,
                                 chain.mount_y_rad, chain.pan_zero_rad, chain.tilt_zero_rad}) {
    text += printed("%.6f ", angle_rad);
  }
  return fnv1a(text + printed("%d %d", chain.pan_sign, chain.tilt_sign));
}

std::string to_text(const SavedSkyline& saved) {
  const HidingSkyline& skyline = saved.skyline;
  std::string text(kHead);
  text += "station " + saved.owner.station + "\n";
  text += printed("calibration %" PRId64 "\nchain %016" PRIx64 "\nbegun %" PRId64 "\n",
                  saved.owner.calibration_id, saved.owner.chain, skyline.begun_us);
  text += printed("camera %.3f %.3f %.3f\n", skyline.camera_ecef.x(), skyline.camera_ecef.y(),
                  skyline.camera_ecef.z());
  for (int sector = 0; sector < land::SeenSkyline::kSectors; ++sector) {
    for (const auto& [column, crest] : skyline.crests.sector(sector)) {
      text += printed("%d %.5f %.5f %.1f %d\n", column, degrees(crest.elevation_rad),
                      std::max(1e-5, degrees(crest.sd_rad)), crest.hides_from_m,
                      crest.disagrees ? 1 : 0);
    }
  }
  return text + sum_line(text);
}

std::variant<SavedSkyline, std::string> saved_skyline_from(std::string_view text) {
  if (!text.starts_with(kHead)) return std::string("line 1: is not a saved skyline");
  const std::size_t end = text.rfind(kSum);
  if (end == std::string_view::npos || text[end - 1] != '\n' ||
      text.substr(end) != sum_line(text.substr(0, end))) {
    return std::string("is damaged: wrong checksum");
  }
  SavedSkyline saved;
  std::istringstream lines(std::string(text.substr(kHead.size(), end - kHead.size())));
  auto& camera = saved.skyline.camera_ecef;
  int line = 2;
  const bool has_head = read_line(lines, "station", saved.owner.station) && ++line > 0 &&
                        read_line(lines, "calibration", saved.owner.calibration_id) && ++line > 0 &&
                        read_hex(lines, "chain", saved.owner.chain) && ++line > 0 &&
                        read_line(lines, "begun", saved.skyline.begun_us) && ++line > 0 &&
                        read_line(lines, "camera", camera.x(), camera.y(), camera.z()) &&
                        ++line > 0;
  bool is_good = has_head && camera.allFinite();
  for (int column = -1; is_good && lines.peek() != EOF; ++line) {
    is_good = read_column(lines, column, saved.skyline.crests, column);
    if (!is_good) break;
  }
  if (!is_good) return "line " + std::to_string(line) + ": is not that of a saved skyline";
  return saved;
}

std::string why_not_used(const SavedSkyline& saved, const SkylineOwner& owner) {
  if (saved.owner.station != owner.station) return "is of station " + saved.owner.station;
  if (saved.owner.calibration_id != owner.calibration_id) {
    return "is of calibration " + std::to_string(saved.owner.calibration_id) + ", not of " +
           std::to_string(owner.calibration_id);
  }
  if (saved.owner.chain != owner.chain) return "is of another heading, tilt or mounting";
  return {};
}

}  // namespace ols::skyline
