// Entities of one kind by id, as JSON objects. Each field has the revision of its last change. A
// viewer gets whatever has changed since its last revision, and needs no queue of its own. Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace ols::console {

using Json = nlohmann::json;
// The number of changes of the whole site's state.
using Revision = std::uint64_t;

class EntityTable {
 public:
  explicit EntityTable(std::size_t most) : most_(most) {}

  // Sets these fields of an entity; its other fields stay. The revision grows only if a value
  // differs. False if the table is full and no entity is stale.
  bool set(const std::string& id, const Json& fields, double now_s, Revision& revision);
  // Sets one field of a known entity, but does not make the entity less stale.
  void mark(const std::string& id, const std::string& field, const Json& value, Revision& revision);
  void remove(const std::string& id, Revision& revision);
  void clear(Revision& revision);

  // If an entity was not set for stale_s, marks it as stale ("stale": true); if it was not set for
  // forget_s, removes it. Returns the ids of the entities that have just become stale.
  std::vector<std::string> age(double now_s, double stale_s, double forget_s, Revision& revision);

  const Json* find(const std::string& id) const;
  std::size_t size() const { return entities_.size(); }
  std::size_t stale() const;
  std::vector<std::string> ids() const;
  Json all() const;                    // an array of all objects, each with its "id"
  Json changed(Revision since) const;  // an array of objects with "id" and the fields changed since
  // The ids removed since that revision; nullopt if the revision is too old to know.
  std::optional<Json> gone(Revision since) const;

 private:
  struct Entity {
    Json fields = Json::object();
    std::map<std::string, Revision> changed;
    double heard_s = 0.0;
  };
  void put(Entity& entity, const std::string& field, const Json& value, Revision& revision);
  bool make_room(Revision& revision);

  static constexpr std::size_t kMostGone = 1000;
  std::size_t most_;
  std::map<std::string, Entity> entities_;
  std::deque<std::pair<Revision, std::string>> gone_;
  Revision forgotten_ = 0;  // revision of the newest removal that is no longer in gone_
};

}  // namespace ols::console
