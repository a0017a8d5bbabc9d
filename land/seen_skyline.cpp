#include "land/seen_skyline.h"

#include <algorithm>

namespace ols::land {

int SeenSkyline::column_of(double azimuth_rad) {
  const auto column = static_cast<int>(wrap_two_pi(azimuth_rad) / (2.0 * kPi) * kColumns);
  return std::min(column, kColumns - 1);
}

void SeenSkyline::set(int column, const SeenCrest& crest) {
  if (crests_.empty()) crests_.resize(kColumns);
  auto& at = crests_[static_cast<std::size_t>(column)];
  if (!at) ++count_;
  at = crest;
}

void SeenSkyline::remove(int column) {
  if (crests_.empty()) return;
  auto& at = crests_[static_cast<std::size_t>(column)];
  if (at) --count_;
  at.reset();
}

void SeenSkyline::set_sector(int sector, std::span<const Column> columns) {
  const int first = sector * kSectorColumns;
  for (int column = first; column < first + kSectorColumns; ++column) remove(column);
  for (const auto& [column, crest] : columns) {
    if (column / kSectorColumns == sector) set(column, crest);
  }
}

std::vector<SeenSkyline::Column> SeenSkyline::sector(int sector) const {
  std::vector<Column> columns;
  const int first = sector * kSectorColumns;
  for (int column = first; column < first + kSectorColumns && !crests_.empty(); ++column) {
    const auto& at = crests_[static_cast<std::size_t>(column)];
    if (at) columns.push_back({column, *at});
  }
  return columns;
}

std::optional<SeenCrest> SeenSkyline::at(double azimuth_rad) const {
  if (crests_.empty()) return std::nullopt;
  const int column = column_of(azimuth_rad);
  for (const int beside : {0, 1, -1, 2, -2}) {
    const auto& crest = crests_[static_cast<std::size_t>((column + beside + kColumns) % kColumns)];
    if (crest) return crest;
  }
  return std::nullopt;
}

Skyline SeenSkyline::hiding(const Skyline& model, double azimuth_rad, double distance_m) const {
  const auto seen = at(azimuth_rad);
  if (!seen || seen->hides_from_m == 0.0 || distance_m < seen->hides_from_m) return model;
  const bool is_beside = !crests_[static_cast<std::size_t>(column_of(azimuth_rad))];
  if (is_beside && seen->elevation_rad < model.elevation_rad) return model;
  return {seen->elevation_rad, seen->sd_rad, seen->hides_from_m};
}

}  // namespace ols::land
