#include "console/viewers.h"

#include <algorithm>
#include <utility>

#include "conditions/alarm_json.h"

namespace ols::console {
namespace {

constexpr std::size_t kMostTexts = 64;
constexpr double kNever_s = -1e9;

void queue(Viewer& viewer, std::string text) {
  viewer.texts.push_back(std::move(text));
  if (viewer.texts.size() > kMostTexts) viewer.texts.pop_front();
}

}  // namespace

std::string dumped(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string Viewers::distinct(const std::string& name) const {
  std::string result = name;
  const auto is_taken = [&result](const auto& entry) { return entry.second.name == result; };
  for (int i = 2; std::ranges::any_of(viewers_, is_taken); ++i) {
    result = name + " " + std::to_string(i);
  }
  return result;
}

std::uint64_t Viewers::open(const std::string& name, Role role) {
  Viewer viewer;
  viewer.name = distinct(name);
  viewer.account = name;
  viewer.role = role;
  viewers_.emplace(++numbers_, std::move(viewer));
  return numbers_;
}

Viewer* Viewers::find(std::uint64_t id) {
  const auto found = viewers_.find(id);
  return found == viewers_.end() ? nullptr : &found->second;
}

Person Viewers::person(const std::string& account, std::uint64_t id) const {
  const auto known = viewers_.find(id);
  if (known == viewers_.end() || known->second.account != account) return {account, 0};
  return {known->second.name, id};
}

void Viewers::answer(std::uint64_t id, std::int64_t number, const std::string& station,
                     const Outcome& refusal) {
  tell(id, {{"kind", "answer"},
            {"number", number},
            {"station", station},
            {"accepted", refusal.empty()},
            {"why", refusal.text},
            {"refusal", refusal.empty() ? Json(nullptr) : Json(refusal)}});
}

void Viewers::tell(std::uint64_t id, const Json& message) {
  if (Viewer* const viewer = find(id)) queue(*viewer, dumped(message));
}

void Viewers::tell_all(const Json& message) {
  for (auto& [id, viewer] : viewers_) queue(viewer, dumped(message));
}

std::optional<std::string> Viewers::next_text(std::uint64_t id, std::int64_t utime_us) {
  Viewer& viewer = at(id);
  if (!std::exchange(viewer.is_greeted, true)) {
    return dumped({{"kind", "hello"},
                   {"viewer", id},
                   {"name", viewer.name},
                   {"role", std::string(console::name(viewer.role))},
                   {"time_us", utime_us}});
  }
  if (viewer.texts.empty()) return std::nullopt;
  std::string text = std::move(viewer.texts.front());
  viewer.texts.pop_front();
  return text;
}

WatchedVideos Viewers::watched(const std::map<std::string, std::string>& addresses) const {
  WatchedVideos watched;
  for (const auto& [id, viewer] : viewers_) {
    for (const auto& [station, address] : addresses) {
      if (viewer.view.watched.contains(station)) watched[{station, viewer.view.codec}] = address;
    }
  }
  return watched;
}

void Viewers::keep_only(const std::function<bool(const std::string&)>& is_known) {
  for (auto& [id, viewer] : viewers_) {
    std::erase_if(viewer.view.sent, [&](const auto& sent) { return !is_known(sent.first); });
  }
}

void Viewers::renew(bool whole) {
  for (auto& [id, viewer] : viewers_) {
    viewer.sent_s = kNever_s;
    if (whole) viewer.sent = 0;
  }
}

}  // namespace ols::console
