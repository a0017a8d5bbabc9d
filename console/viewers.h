// The viewers (the connected browsers): the user of each, what it was sent, and the texts that wait
// to be sent. Pure.
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
  std::string name;          // empty: unknown
  std::uint64_t viewer = 0;  // number of the browser; 0: unknown
};

struct Viewer {
  std::string name, account;  // "ana 2", "ana"
  Role role = Role::kViewer;
  bool is_greeted = false;
  Revision sent = 0;  // revision of the site's state that was sent last; 0: none yet
  double sent_s = -1e9;
  LatestPictures::View view;
  std::deque<std::string> texts;  // texts still to be sent
};

// The text of a JSON value, with invalid UTF-8 replaced.
std::string dumped(const Json& json);

class Viewers {
 public:
  // Call when a browser has opened its WebSocket; returns the viewer's number, from 1. The second
  // viewer of the user "ana" is called "ana 2".
  std::uint64_t open(const std::string& name, Role role);
  void close(std::uint64_t id) { viewers_.erase(id); }

  // Null if the browser is gone.
  Viewer* find(std::uint64_t id);
  // Throws std::out_of_range if the browser is gone.
  Viewer& at(std::uint64_t id) { return viewers_.at(id); }
  const Viewer& at(std::uint64_t id) const { return viewers_.at(id); }
  std::size_t size() const { return viewers_.size(); }
  // The person who sent an HTTP request. `account`: the user of the session. `id`: the number of
  // the browser, as the request states it; ignored if that browser belongs to another user.
  Person person(const std::string& account, std::uint64_t id) const;

  // Answers the request with this number. If the browser is gone, this function and tell() do
  // nothing.
  void answer(std::uint64_t id, std::int64_t number, const std::string& station,
              const Outcome& refusal);
  // Queues a text. If too many wait, the oldest are dropped.
  void tell(std::uint64_t id, const Json& message);
  void tell_all(const Json& message);
  // The next text to send: first the greeting, then the oldest text that waits; nullopt: there is
  // none.
  std::optional<std::string> next_text(std::uint64_t id, std::int64_t utime_us);

  // The videos that viewers watch, of the stations in `addresses` (address by station).
  WatchedVideos watched(const std::map<std::string, std::string>& addresses) const;
  void keep_only(const std::function<bool(const std::string&)>& is_known);
  // Makes the state due at once for every viewer; whole: the whole state, otherwise only the
  // changes.
  void renew(bool whole);

 private:
  std::string distinct(const std::string& name) const;

  std::map<std::uint64_t, Viewer> viewers_;
  std::uint64_t numbers_ = 0;
};

}  // namespace ols::console
