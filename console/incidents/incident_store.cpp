#include "console/incidents/incident_store.h"

#include <algorithm>
#include <charconv>
#include <exception>
#include <filesystem>
#include <functional>
#include <set>
#include <stdexcept>

#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "conditions/alarms.h"

namespace ols::console {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr int kVersion = 1;
constexpr std::size_t kMostBytes = 4'000'000;
constexpr const char* kAreas = "areas.json";

// The part of a file under a key, if it is of this version.
Json part_of(const std::string& path, const char* key) {
  const Json json = Json::parse(read_small_file(path, kMostBytes));
  const int version = json.at("version").get<int>();
  if (version != kVersion) {
    throw std::invalid_argument("version " + std::to_string(version) +
                                ", and this program knows version 1");
  }
  return json.at(key);
}

std::string text_of(const char* key, Json part) {
  return Json{{"version", kVersion}, {key, std::move(part)}}.dump(1, ' ', false,
                                                                  Json::error_handler_t::replace) +
         "\n";
}

// The number of a file NUMBER.json; 0 for any other file.
std::uint64_t number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  const bool is_number = error == std::errc() && end == stem.data() + stem.size();
  return is_number && file.extension() == ".json" ? number : 0;
}

}  // namespace

bool IncidentStore::tried(const std::string& file, const std::function<void()>& read_it) {
  try {
    read_it();
    return true;
  } catch (const std::exception& error) {
    unread_.push_back(alarm::incidents_unread(file, error.what()));
    return false;
  }
}

void IncidentStore::read_incident(std::uint64_t number, KeptIncidents& kept) {
  const std::string stem = folder_ + "/" + std::to_string(number);
  tried(stem + ".json", [&] {
    Incident incident = incident_from(part_of(stem + ".json", "incident"));
    if (incident.number != number) throw std::invalid_argument("it is of another number");
    const bool has_picture = !incident.picture.is_null();
    kept.incidents.push_back(std::move(incident));
    if (!has_picture) return;
    tried(stem + ".jpg",
          [&] { kept.pictures[number] = read_small_file(stem + ".jpg", kMostPictureBytes); });
  });
}

KeptIncidents IncidentStore::read() {
  KeptIncidents kept;
  std::error_code why;
  if (fs::status(folder_, why).type() == fs::file_type::not_found) return kept;
  const std::string areas = folder_ + "/" + kAreas;
  kept.may_change_areas = tried(areas, [&] {
    if (!fs::exists(areas)) return;
    std::vector<Area> read;
    for (const Json& area : part_of(areas, "areas")) read.push_back(area_from(area));
    kept.areas = std::move(read);
  });
  is_listed_ = tried(folder_, [&] {
    std::set<std::uint64_t> numbers;
    for (const auto& entry : fs::directory_iterator(folder_)) {
      numbers.insert(number_of(entry.path()));
    }
    numbers.erase(0);
    for (const std::uint64_t number : numbers) read_incident(number, kept);
    if (!numbers.empty()) kept.numbers = std::max(kept.numbers, *numbers.rbegin());
  });
  kept.may_change_areas = kept.may_change_areas && is_listed_;
  return kept;
}

bool IncidentStore::is_written(const std::function<void()>& write_it) {
  try {
    if (!is_listed_) throw std::runtime_error(folder_ + " could not be read");
    write_it();
    return true;
  } catch (const std::exception& error) {
    why_unsaved_ = error.what();
    return false;
  }
}

void IncidentStore::keep(const IncidentBook& book, const IncidentBook::News& news, double now_s) {
  const bool is_new = news.areas || !news.incidents.empty() || !news.forgotten.empty();
  if (!is_new && (why_unsaved_.empty() || now_s < again_s_)) return;
  again_s_ = now_s + kAgain_s;
  why_unsaved_.clear();
  unsaved_.areas = unsaved_.areas || news.areas;
  unsaved_.pictures.insert(news.pictures.begin(), news.pictures.end());
  unsaved_.incidents.insert(news.incidents.begin(), news.incidents.end());
  unsaved_.forgotten.insert(unsaved_.forgotten.end(), news.forgotten.begin(), news.forgotten.end());
  if (unsaved_.areas && is_written([&] { write(book.watch().areas()); })) unsaved_.areas = false;
  std::erase_if(unsaved_.forgotten,
                [&](std::uint64_t number) { return is_written([&] { remove(number); }); });
  // An incident that was forgotten meanwhile needs no file.
  std::erase_if(unsaved_.pictures, [&](std::uint64_t number) {
    const std::string* jpeg = book.picture(number);
    return jpeg == nullptr ||
           is_written([&] { write_file(std::to_string(number) + ".jpg", *jpeg); });
  });
  std::erase_if(unsaved_.incidents, [&](std::uint64_t number) {
    const auto incident = book.watch().incidents().find(number);
    return incident == book.watch().incidents().end() ||
           is_written([&] { write(incident->second); });
  });
}

void IncidentStore::write_file(const std::string& name, const std::string& content) const {
  fs::create_directories(folder_);
  AtomicFile file(folder_ + "/" + name);
  file.stream() << content;
  file.commit();
}

void IncidentStore::write(const std::vector<Area>& areas) const {
  Json list = Json::array();
  for (const Area& area : areas) list.push_back(json_of(area));
  write_file(kAreas, text_of("areas", std::move(list)));
}

void IncidentStore::write(const Incident& incident) const {
  write_file(std::to_string(incident.number) + ".json", text_of("incident", json_of(incident)));
}

void IncidentStore::remove(std::uint64_t number) const {
  for (const char* suffix : {".json", ".jpg"}) {
    fs::remove(folder_ + "/" + std::to_string(number) + suffix);
  }
}

std::vector<Alarm> IncidentStore::alarms() const {
  std::vector<Alarm> alarms = unread_;
  if (!why_unsaved_.empty()) alarms.push_back(alarm::incidents_unsaved(why_unsaved_));
  return alarms;
}

}  // namespace ols::console
