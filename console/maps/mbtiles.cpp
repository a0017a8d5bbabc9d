#include "console/maps/mbtiles.h"

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace ols::console {
namespace {

constexpr int kMostMetadata = 1000;
constexpr int kPatience_ms = 200;
constexpr int kMostSteps = 50'000'000;  // of SQLite's machine, for one question to a hostile file

std::string text_of(sqlite3_stmt* row, int column) {
  const auto* text = sqlite3_column_text(row, column);
  const int bytes = sqlite3_column_bytes(row, column);
  return text == nullptr
             ? std::string()
             : std::string(reinterpret_cast<const char*>(text), static_cast<std::size_t>(bytes));
}

int whole(const std::string& text, int otherwise) {
  int value = otherwise;
  return std::sscanf(text.c_str(), "%d", &value) == 1 ? value : otherwise;
}

}  // namespace

Mbtiles::Mbtiles(const std::string& path) {
  sqlite3* opened = nullptr;
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;
  const int code = sqlite3_open_v2(path.c_str(), &opened, flags, nullptr);
  database_.reset(opened);
  if (code != SQLITE_OK) fail();
  sqlite3_busy_timeout(opened, kPatience_ms);
  sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, static_cast<int>(kMostTileBytes));
  sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_progress_handler(
      opened, kMostSteps, [](void*) { return 1; }, nullptr);
  info_.name = std::filesystem::path(path).stem().string();
  read_metadata();
  info_ = plausible(info_);
  tile_ = prepare(
      "SELECT tile_data FROM tiles WHERE zoom_level = ?1 AND tile_column = ?2 AND tile_row = ?3");
}

void Mbtiles::fail() const {
  throw std::runtime_error(database_ ? sqlite3_errmsg(database_.get()) : "cannot be opened");
}

Mbtiles::Query Mbtiles::prepare(const char* text) const {
  sqlite3_stmt* query = nullptr;
  if (sqlite3_prepare_v2(database_.get(), text, -1, &query, nullptr) != SQLITE_OK) fail();
  return Query(query);
}

void Mbtiles::read_metadata() {
  const Query query = prepare("SELECT name, value FROM metadata");
  int code = SQLITE_ROW;
  for (int i = 0; i < kMostMetadata && (code = sqlite3_step(query.get())) == SQLITE_ROW; ++i) {
    const std::string name = text_of(query.get(), 0), value = text_of(query.get(), 1);
    if (name == "name" && !value.empty()) info_.name = value;
    if (name == "attribution") info_.attribution = value;
    if (name == "minzoom") info_.min_zoom = whole(value, info_.min_zoom);
    if (name == "maxzoom") info_.max_zoom = whole(value, info_.max_zoom);
    if (name == "format" && value == "pbf") {
      throw std::runtime_error("holds vector tiles; only maps of pictures are shown");
    }
    auto& b = info_.bounds_deg;
    if (name == "bounds" &&
        std::sscanf(value.c_str(), "%lf,%lf,%lf,%lf", b.data(), &b[1], &b[2], &b[3]) != 4) {
      info_.bounds_deg = MapInfo{}.bounds_deg;
    }
  }
  if (code != SQLITE_ROW && code != SQLITE_DONE) fail();
}

std::optional<std::string> Mbtiles::tile(const TileAddress& a) {
  sqlite3_reset(tile_.get());
  sqlite3_bind_int(tile_.get(), 1, a.zoom);
  sqlite3_bind_int(tile_.get(), 2, a.column);
  sqlite3_bind_int(tile_.get(), 3, (1 << a.zoom) - 1 - a.row);
  const int code = sqlite3_step(tile_.get());
  if (code == SQLITE_DONE) return std::nullopt;
  if (code != SQLITE_ROW) fail();
  const void* bytes = sqlite3_column_blob(tile_.get(), 0);
  const int size = sqlite3_column_bytes(tile_.get(), 0);
  if (bytes == nullptr || size <= 0) return std::nullopt;
  return std::string(static_cast<const char*>(bytes), static_cast<std::size_t>(size));
}

}  // namespace ols::console
