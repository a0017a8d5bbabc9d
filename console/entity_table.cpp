#include "console/entity_table.h"

#include <algorithm>

namespace ols::console {

void EntityTable::put(Entity& entity, const std::string& field, const Json& value,
                      Revision& revision) {
  const auto known = entity.fields.find(field);
  if (known != entity.fields.end() && *known == value) return;
  entity.fields[field] = value;
  entity.changed[field] = ++revision;
}

bool EntityTable::make_room(Revision& revision) {
  if (entities_.size() < most_) return true;
  const auto stale = std::ranges::find_if(
      entities_, [](const auto& e) { return e.second.fields.value("stale", false); });
  if (stale == entities_.end()) return false;
  remove(std::string(stale->first), revision);
  return true;
}

bool EntityTable::set(const std::string& id, const Json& fields, double now_s, Revision& revision) {
  if (!entities_.contains(id) && !make_room(revision)) return false;
  Entity& entity = entities_[id];
  for (const auto& [field, value] : fields.items()) put(entity, field, value, revision);
  put(entity, "stale", false, revision);
  entity.heard_s = now_s;
  return true;
}

void EntityTable::mark(const std::string& id, const std::string& field, const Json& value,
                       Revision& revision) {
  const auto entity = entities_.find(id);
  if (entity != entities_.end()) put(entity->second, field, value, revision);
}

void EntityTable::remove(const std::string& id, Revision& revision) {
  if (entities_.erase(id) == 0) return;
  gone_.emplace_back(++revision, id);
  if (gone_.size() <= kMostGone) return;
  forgotten_ = gone_.front().first;
  gone_.pop_front();
}

void EntityTable::clear(Revision& revision) {
  for (const std::string& id : ids()) remove(id, revision);
}

std::vector<std::string> EntityTable::age(double now_s, double stale_s, double forget_s,
                                          Revision& revision) {
  std::vector<std::string> stale, forgotten;
  for (auto& [id, entity] : entities_) {
    const double silent_s = now_s - entity.heard_s;
    if (silent_s > forget_s) {
      forgotten.push_back(id);
    } else if (silent_s > stale_s && !entity.fields.value("stale", false)) {
      put(entity, "stale", true, revision);
      stale.push_back(id);
    }
  }
  for (const std::string& id : forgotten) remove(id, revision);
  return stale;
}

const Json* EntityTable::find(const std::string& id) const {
  const auto entity = entities_.find(id);
  return entity == entities_.end() ? nullptr : &entity->second.fields;
}

std::size_t EntityTable::stale() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      entities_, [](const auto& e) { return e.second.fields.value("stale", false); }));
}

std::vector<std::string> EntityTable::ids() const {
  std::vector<std::string> ids;
  for (const auto& [id, entity] : entities_) ids.push_back(id);
  return ids;
}

Json EntityTable::all() const {
  Json result = Json::array();
  for (const auto& [id, entity] : entities_) {
    result.push_back(entity.fields);
    result.back()["id"] = id;
  }
  return result;
}

Json EntityTable::changed(Revision since) const {
  Json result = Json::array();
  for (const auto& [id, entity] : entities_) {
    Json fields = Json::object();
    for (const auto& [field, revision] : entity.changed) {
      if (revision > since) fields[field] = entity.fields.at(field);
    }
    if (fields.empty()) continue;
    fields["id"] = id;
    result.push_back(std::move(fields));
  }
  return result;
}

std::optional<Json> EntityTable::gone(Revision since) const {
  if (since < forgotten_) return std::nullopt;
  Json result = Json::array();
  for (const auto& [revision, id] : gone_) {
    if (revision > since && !entities_.contains(id)) result.push_back(id);
  }
  return result;
}

}  // namespace ols::console
