#include "console/replay/timeline.h"

#include <algorithm>
#include <utility>

namespace ols::console {
namespace {

std::size_t size_of(const Moment& moment) {
  std::size_t size =
      moment.site.snapshot().dump(-1, ' ', false, Json::error_handler_t::replace).size();
  for (const auto& [station, picture] : moment.pictures) size += picture.bytes.size();
  return size;
}

Json mark_of(const Json& event, const Json& kind, const Json& utime_us) {
  return {{"utime_us", utime_us},           {"kind", kind},
          {"station", event.at("station")}, {"who", event.at("who")},
          {"text", event.at("text")},       {"said", event.at("said")},
          {"outcome", event.at("outcome")}, {"refusal", event.at("refusal")}};
}

// An alarm that has come back within a minute is the same event.
bool begins_again(const Json& event, const Json& mark) {
  return event.at("utime_us") != mark.at("utime_us");
}

}  // namespace

void Timeline::add_mark(Json mark) {
  ++changes_;
  if (marks_.size() < kMostMarks) {
    marks_.push_back(std::move(mark));
  } else {
    ++left_out_;
  }
}

void Timeline::add_marks(const Console& console) {
  for (const Json& event : console.events_since(std::exchange(seen_, console.revision()))) {
    const auto number = event.at("number").get<std::uint64_t>();
    const auto known = of_event_.find(number);
    const bool is_alarm = event.at("kind") == "alarm";
    if (known == of_event_.end() || (is_alarm && begins_again(event, marks_[known->second]))) {
      if (marks_.size() < kMostMarks) of_event_[number] = marks_.size();
      add_mark(mark_of(event, event.at("kind"), event.at("utime_us")));
    } else {
      for (const char* one : {"outcome", "refusal"}) marks_[known->second][one] = event.at(one);
      ++changes_;
    }
    if (!event.at("over_us").is_null()) add_mark(mark_of(event, "alarm_over", event.at("over_us")));
  }
}

void Timeline::receive(const ReceivedTarget& target, std::int64_t utime_us) {
  using What = ReceivedTarget::What;
  if (target.boot_id != fusion_boot_) alive_.clear();
  fusion_boot_ = target.boot_id;
  const bool is_born = target.what == What::kPosition && alive_.size() < kMostTargets &&
                       alive_.insert(target.id).second;
  const bool has_ended = target.what == What::kDropped && alive_.erase(target.id) != 0;
  if (!is_born && !has_ended) return;
  add_mark({{"utime_us", utime_us},
            {"kind", is_born ? "birth" : "end"},
            {"station", ""},
            {"who", ""},
            {"text", target.id},
            {"outcome", ""},
            {"refusal", nullptr}});
}

void Timeline::thin_out() {
  std::size_t kept = 0;
  snapshot_bytes_ = 0;
  for (std::size_t i = 0; i < snapshots_.size(); i += 2, ++kept) {
    if (i != kept) snapshots_[kept] = std::move(snapshots_[i]);
    snapshot_bytes_ += snapshots_[kept].bytes;
  }
  snapshots_.erase(snapshots_.begin() + static_cast<std::ptrdiff_t>(kept), snapshots_.end());
  interval_us_ *= 2;
}

void Timeline::add_snapshot(std::uint64_t offset, const Console& console) {
  snapshots_.push_back({last_us_, offset, 0, console.moment()});
  snapshots_.back().bytes = size_of(snapshots_.back().moment);
  snapshot_bytes_ += snapshots_.back().bytes;
  while (snapshot_bytes_ > kMostSnapshotBytes && snapshots_.size() > 1) thin_out();
}

void Timeline::reach(std::int64_t utime_us, std::uint64_t offset, const Console& console) {
  if (first_us_ == 0) first_us_ = utime_us;
  last_us_ = utime_us;
  if (utime_us < looked_us_ + kLook_us) return;
  looked_us_ = utime_us;
  add_marks(console);
  if (snapshots_.empty() || utime_us >= snapshots_.back().utime_us + interval_us_) {
    add_snapshot(offset, console);
  }
}

const Snapshot* Timeline::before(std::int64_t utime_us) const {
  const auto after = std::ranges::upper_bound(snapshots_, utime_us, {}, &Snapshot::utime_us);
  return after == snapshots_.begin() ? nullptr : &*(after - 1);
}

Json Timeline::json() const {
  std::vector<Json> marks = marks_;
  std::ranges::stable_sort(marks, {},
                           [](const Json& m) { return m.at("utime_us").get<std::int64_t>(); });
  return {{"first_us", first_us_},
          {"last_us", last_us_},
          {"marks", std::move(marks)},
          {"marks_left_out", left_out_}};
}

}  // namespace ols::console
