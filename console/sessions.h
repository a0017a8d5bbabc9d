// The logged-in users, by the token in their cookie. Pure: the caller draws the tokens.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "console/users.h"

namespace ols::console {

struct Session {
  std::string name;
  Role role = Role::kViewer;
  double until_s = 0.0;  // monotonic
};

class Sessions {
 public:
  explicit Sessions(double length_s) : length_s_(length_s) {}
  // Begins a session. If there are more than kMost, removes the one that would end first.
  void begin(const std::string& token, const std::string& name, Role role, double now_s);
  std::optional<Session> find(const std::string& token, double now_s) const;
  void end(const std::string& token) { sessions_.erase(token); }
  // Ends all sessions of a person.
  void end_of(const std::string& name);
  // The number of sessions of each person, by name.
  std::map<std::string, int> counts(double now_s) const;
  static constexpr std::size_t kMost = 200;

 private:
  double length_s_;
  std::map<std::string, Session> sessions_;
};

inline constexpr const char* kCookie = "ols_session";
// The token in a Cookie header; empty: it has none.
std::string token_in(const std::string& cookies);

}  // namespace ols::console
