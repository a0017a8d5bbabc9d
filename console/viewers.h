// The browsers that are connected: who sits there, what each has been sent and what it is still to
// be told. Pure.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "console/entity_table.h"
#include "console/latest_pictures.h"
#include "console/users.h"

namespace ols::console {

// The person who gives an order.
struct Person {
  std::string name;          // empty: unknown to this console
  std::uint64_t viewer = 0;  // the browser; 0: unknown
};

struct Viewer {
  std::string name, account;  // "ana 2", "ana"
  Role role = Role::kViewer;
  bool is_greeted = false;
  Revision sent = 0;  // of the site's state; 0: nothing yet
  double sent_s = -1e9;
  LatestPictures::View view;
  std::deque<std::string> texts;  // still to be sent
};

// JSON as it is sent: invalid UTF-8 is replaced.
std::string dumped(const Json& json);

class Viewers {
 public:
  // A browser has opened its WebSocket; returns the viewer's number, from 1. A second one of the
  // same name is called "ana 2".
  std::uint64_t open(const std::string& name, Role role);
  void close(std::uint64_t id) { viewers_.erase(id); }

  // Null: it is gone.
  Viewer* find(std::uint64_t id);
  // Throws std::out_of_range: it is gone.
  Viewer& at(std::uint64_t id) { return viewers_.at(id); }
  const Viewer& at(std::uint64_t id) const { return viewers_.at(id); }
  std::size_t size() const { return viewers_.size(); }
  // The person behind a request outside of the WebSocket. `id`: the browser; used only if it
  // belongs to that account.
  Person person(const std::string& account, std::uint64_t id) const;

  // Answers a request by its number. To a browser that is gone, this and tell() do nothing.
  void answer(std::uint64_t id, std::int64_t number, const std::string& station,
              const Outcome& refusal);
  // Of many texts that nobody takes, the oldest are dropped.
  void tell(std::uint64_t id, const Json& message);
  void tell_all(const Json& message);
  // The greeting first, then the oldest text; nullopt: there is none.
  std::optional<std::string> next_text(std::uint64_t id, std::int64_t utime_us);

  // Of these stations and their addresses, the videos that somebody watches.
  WatchedVideos watched(const std::map<std::string, std::string>& addresses) const;
  void keep_only(const std::function<bool(const std::string&)>& is_known);
  // Every viewer gets the state at once: the whole of it, or what has changed.
  void renew(bool whole);

 private:
  std::string distinct(const std::string& name) const;

  std::map<std::uint64_t, Viewer> viewers_;
  std::uint64_t numbers_ = 0;
};

}  // namespace ols::console
