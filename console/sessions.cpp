#include "console/sessions.h"

#include <algorithm>
#include <string_view>

namespace ols::console {

void Sessions::begin(const std::string& token, const std::string& name, Role role, double now_s) {
  std::erase_if(sessions_, [&](const auto& s) { return s.second.until_s <= now_s; });
  if (sessions_.size() >= kMost) {
    sessions_.erase(
        std::ranges::min_element(sessions_, {}, [](const auto& s) { return s.second.until_s; }));
  }
  sessions_[token] = {name, role, now_s + length_s_};
}

std::optional<Session> Sessions::find(const std::string& token, double now_s) const {
  const auto session = sessions_.find(token);
  if (session == sessions_.end() || session->second.until_s <= now_s) return std::nullopt;
  return session->second;
}

void Sessions::end_of(const std::string& name) {
  std::erase_if(sessions_, [&](const auto& s) { return s.second.name == name; });
}

std::map<std::string, int> Sessions::counts(double now_s) const {
  std::map<std::string, int> counts;
  for (const auto& [token, session] : sessions_) {
    if (session.until_s > now_s) ++counts[session.name];
  }
  return counts;
}

std::string token_in(const std::string& cookies) {
  std::string_view rest = cookies;
  const std::string wanted = std::string(kCookie) + "=";
  while (!rest.empty()) {
    const auto end = std::min(rest.find(';'), rest.size());
    std::string_view one = rest.substr(0, end);
    while (one.starts_with(' ')) one.remove_prefix(1);
    if (one.starts_with(wanted)) return std::string(one.substr(wanted.size()));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return "";
}

}  // namespace ols::console
