#include "console/maps/map_library.h"

#include <filesystem>
#include <set>
#include <stdexcept>

#include "base/text/plain_text.h"
#include "console/maps/mbtiles.h"
#include "console/maps/pmtiles.h"
#include "console/maps/tile_folder.h"

namespace ols::console {
namespace {

namespace fs = std::filesystem;

WebResponse json(int status, const Json& body) {
  return {
      status, "application/json", body.dump(-1, ' ', false, Json::error_handler_t::replace), {}};
}

// Null for what is no map.
std::unique_ptr<TileStore> opened(const fs::path& path) {
  if (path.extension() == ".mbtiles") return std::make_unique<Mbtiles>(path.string());
  if (path.extension() == ".pmtiles") return std::make_unique<Pmtiles>(path.string());
  if (fs::is_directory(path)) return std::make_unique<TileFolder>(path.string());
  return nullptr;
}

}  // namespace

void MapLibrary::open(const std::string& name, std::int64_t changed_ns) {
  Entry entry{nullptr, nullptr, "", changed_ns};
  const fs::path path = fs::path(folder_) / name;
  try {
    if (path.extension() == ".geojson")
      entry.accuracy = std::make_unique<AccuracyFile>(path.string());
    if (!entry.accuracy) entry.store = opened(path);
    if (!entry.accuracy && !entry.store) return;
  } catch (const std::exception& error) {
    entry.problem = plain_text(error.what());
  }
  maps_[name] = std::move(entry);
}

void MapLibrary::look() {
  folder_problem_.clear();
  std::error_code error;
  if (folder_.empty() || !fs::exists(folder_, error)) return maps_.clear();
  std::set<std::string> present;
  fs::directory_iterator entries(folder_, error);
  if (error) folder_problem_ = folder_ + ": " + error.message();
  for (; !error && entries != fs::directory_iterator(); entries.increment(error)) {
    const std::string name = entries->path().filename().string();
    const auto changed = fs::last_write_time(entries->path(), error);
    if (error || name.starts_with('.') || present.size() >= kMostMaps) continue;
    present.insert(name);
    const auto known = maps_.find(name);
    const std::int64_t changed_ns = changed.time_since_epoch().count();
    if (known == maps_.end() || known->second.changed_ns != changed_ns) open(name, changed_ns);
  }
  std::erase_if(maps_, [&](const auto& map) { return !present.contains(map.first); });
}

WebResponse MapLibrary::list() {
  look();
  Json maps = Json::array();
  for (const auto& [name, entry] : maps_) {
    Json map{{"id", name}, {"name", plain_text(name)}, {"problem", entry.problem}};
    if (entry.store) {
      const MapInfo& info = entry.store->info();
      map["name"] = info.name;
      map["attribution"] = info.attribution;
      map["zoom"] = {info.min_zoom, info.max_zoom};
      map["bounds_deg"] = info.bounds_deg;
    }
    if (entry.accuracy) map["above_m"] = entry.accuracy->heights_m();
    maps.push_back(std::move(map));
  }
  return json(200, {{"maps", std::move(maps)}, {"problem", folder_problem_}});
}

WebResponse MapLibrary::tile(const MapTask& task) {
  if (maps_.empty()) look();
  const auto found = maps_.find(task.map);
  if (found == maps_.end() || !found->second.store || !is_address(task.tile)) {
    return json(404, {{"error", "there is no such map or tile"}});
  }
  try {
    auto picture = found->second.store->tile(task.tile);
    if (!picture) return {204, "text/plain", "", {{"Cache-Control", "max-age=60"}}};
    const std::string type = picture_type(*picture);
    if (type.empty()) throw std::runtime_error("a tile is neither PNG nor JPEG nor WebP");
    return {200, type, std::move(*picture), {{"Cache-Control", "max-age=3600"}}};
  } catch (const std::exception& error) {
    found->second.problem = plain_text(error.what());
    return json(500, {{"error", task.map + ": " + found->second.problem}});
  }
}

WebResponse MapLibrary::accuracy(const MapTask& task) const {
  const auto found = maps_.find(task.map);
  if (found == maps_.end() || !found->second.accuracy) {
    return json(404, {{"error", "there is no such map of the accuracy"}});
  }
  return {200, "application/json", found->second.accuracy->body(), {}};
}

WebResponse MapLibrary::answer(const MapTask& task) {
  if (task.map.empty()) return list();
  return task.accuracy ? accuracy(task) : tile(task);
}

}  // namespace ols::console
