#include "bridge/passage.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/trust/channel_rules.h"
#include "base/trust/trailer.h"

namespace ols::bridge {
namespace {

constexpr double kSettled_s = 60.0;  // a silent station's name is free again
constexpr double kFuture_s = 1.0;
constexpr double kMostOfOne_Hz = 400.0;
constexpr std::size_t kMostNames = 20'000;
constexpr std::size_t kLargestStatus = 32'000, kLargest = 8'000;

std::string regex_of(const std::vector<std::string>& names) {
  if (names.empty()) return ".*";
  std::string regex = "(";
  for (const std::string& name : names) regex.append(regex.size() > 1 ? "|" : "").append(name);
  return regex + ")";
}

// A boot's bearings and statuses are counted each by itself, and one stream holds both.
std::string id_of(const Content& content, const trust::MessageHead& head) {
  const std::string who = content.kind == Kind::kTarget ? "target" : content.station;
  const std::string id =
      who + ":" + std::to_string(head.boot_id) + ":" + std::to_string(head.sequence);
  return content.kind == Kind::kStatus ? id + ":status" : id;
}

std::uint64_t number(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() ? value : 0;
}

std::string text_of(const Headers& headers, const char* name) {
  const auto at = headers.find(name);
  return at == headers.end() ? "" : at->second;
}

void put(const Grant& grant, Headers& headers) {
  if (grant.id.empty()) return;
  headers[kTargetHeader] = grant.id;
  headers[kEpochHeader] = std::to_string(grant.epoch);
  if (!grant.is_confirmed) headers[kUnconfirmedHeader] = "1";
}

void count(Counts& counts, const std::optional<Refusal>& refusal, std::string_view what) {
  if (!refusal) {
    ++counts.passed;
    return;
  }
  ++counts.refused.at(static_cast<std::size_t>(*refusal));
  // A bus gives back what was put onto it, and a fusion goes on with targets that another one owns.
  if (*refusal == Refusal::kOwn || *refusal == Refusal::kNotOwned) return;
  counts.last_refusal = std::string(what.substr(0, 120)) + ": " + to_string(*refusal);
}

}  // namespace

const char* to_string(Refusal reason) {
  switch (reason) {
    case Refusal::kShape:
      return "shape";
    case Refusal::kSize:
      return "size";
    case Refusal::kMalformed:
      return "malformed";
    case Refusal::kName:
      return "name";
    case Refusal::kRate:
      return "rate";
    case Refusal::kStale:
      return "stale";
    case Refusal::kOwn:
      return "own";
    case Refusal::kEpoch:
      return "epoch";
    case Refusal::kNobody:
      return "nobody";
    case Refusal::kNotOwned:
      return "not_owned";
    case Refusal::kCount:
      break;
  }
  return "unknown";
}

std::optional<Outgoing> Passage::out(std::string_view channel, Bytes bytes, const Now& now,
                                     const Owned& owned) {
  Outgoing outgoing;
  const Judged refusal = judge_out(channel, bytes, now, owned, outgoing);
  count(out_, refusal, channel);
  if (refusal) return std::nullopt;
  return outgoing;
}

std::optional<std::string> Passage::in(std::string_view subject, const Headers& headers,
                                       Bytes bytes, const Now& now) {
  std::string channel;
  const Judged refusal = judge_in(subject, headers, bytes, now, channel);
  count(in_, refusal, subject);
  if (refusal) return std::nullopt;
  return channel;
}

Passage::Judged Passage::judge_out(std::string_view channel, Bytes bytes, const Now& now,
                                   const Owned& owned, Outgoing& outgoing) {
  const auto content = content_of(channel);
  if (!content) return Refusal::kShape;
  Subject subject{content->kind, config_.region, config_.site, content->station, content->command};
  if (const Judged refusal = address(*content, now, subject)) return refusal;
  trust::MessageHead head;
  if (const Judged refusal = judge_message(*content, channel, bytes, now, head)) return refusal;
  const bool is_owned = content->kind == Kind::kTarget || content->kind == Kind::kCommand;
  if (is_owned && owned) {
    const auto grant = owned(content->kind, trust::without_trailer(bytes));
    if (!grant) return Refusal::kNotOwned;
    put(*grant, outgoing.headers);
  }
  // A command is never stored, so it needs no number by which it were stored once.
  if (content->kind != Kind::kCommand) outgoing.headers[kIdHeader] = id_of(*content, head);
  outgoing.subject = to_text(subject);
  return std::nullopt;
}

// Where it goes, if it goes at all.
Passage::Judged Passage::address(const Content& content, const Now& now, Subject& subject) {
  if (content.kind == Kind::kTarget) {
    subject = {Kind::kTarget, config_.region};
    return config_.targets ? Judged() : Refusal::kShape;
  }
  const auto place = places_.find(content.station);
  if (content.kind == Kind::kCommand) {
    const bool crosses = std::ranges::count(config_.commands, content.command) > 0;
    if (config_.role != Role::kRegion || !crosses) return Refusal::kShape;
    if (place == places_.end()) return Refusal::kNobody;
    subject.region = place->second.region;
    subject.site = place->second.site;
    return std::nullopt;
  }
  if (config_.role != Role::kSite) return Refusal::kShape;
  if (!is_ours(content.station)) return Refusal::kName;
  return settle(content.station, config_.region, config_.site, now.monotonic_s) ? Judged()
                                                                                : Refusal::kOwn;
}

Passage::Judged Passage::judge_message(const Content& content, std::string_view channel,
                                       Bytes bytes, const Now& now, trust::MessageHead& head) {
  if (bytes.size() > (content.kind == Kind::kStatus ? kLargestStatus : kLargest)) {
    return Refusal::kSize;
  }
  const trust::ChannelRule& rule = *trust::rule_of(channel)->rule;
  auto rate = rates_.find(channel);
  if (rate == rates_.end()) {
    if (rates_.size() >= kMostNames) return Refusal::kRate;
    const double most_hz =
        content.station.empty() ? rule.rate_hz : std::min(rule.rate_hz, kMostOfOne_Hz);
    rate = rates_.emplace(std::string(channel), trust::RateLimit(most_hz)).first;
  }
  if (!rate->second.has(now.monotonic_s)) return Refusal::kRate;
  rate->second.spend();
  const auto read = trust::read_head(trust::without_trailer(bytes), rule.head);
  if (!read) return Refusal::kMalformed;
  head = *read;
  if (rule.head == trust::HeadForm::kStationFirst && head.station != content.station) {
    return Refusal::kName;
  }
  // In floating point: a hostile stamp must not overflow.
  const double age_s =
      1e-6 * (static_cast<double>(now.utime_us) - static_cast<double>(head.utime_us));
  const bool is_fresh = age_s <= config_.command_age_s && age_s >= -kFuture_s;
  return content.kind == Kind::kCommand && !is_fresh ? Refusal::kStale : Judged();
}

Passage::Judged Passage::judge_in(std::string_view text, const Headers& headers, Bytes bytes,
                                  const Now& now, std::string& channel) {
  const auto subject = parse_subject(text);
  if (!subject || subject->kind == Kind::kTarget) return Refusal::kShape;
  const Content content{subject->kind, subject->station, subject->command};
  channel = channel_of(*subject);
  if (const Judged refusal = take(*subject, now)) return refusal;
  trust::MessageHead head;
  if (const Judged refusal = judge_message(content, channel, bytes, now, head)) return refusal;
  if (subject->kind == Kind::kCommand) return obey(*subject, headers, now);
  const char* const kind = subject->kind == Kind::kBearing ? "" : " (status)";
  gaps_.hear(subject->station + kind, head.boot_id, head.sequence, now.monotonic_s);
  return std::nullopt;
}

// Whether it may come in.
Passage::Judged Passage::take(const Subject& subject, const Now& now) {
  const bool is_here = subject.region == config_.region && subject.site == config_.site;
  if (subject.kind == Kind::kCommand) {
    const bool crosses = std::ranges::count(config_.commands, subject.command) > 0;
    if (config_.role != Role::kSite || !is_here || !crosses) return Refusal::kShape;
    return is_ours(subject.station) ? Judged() : Refusal::kName;
  }
  if (config_.role == Role::kSite && is_here) return Refusal::kOwn;
  const bool is_wanted = std::ranges::any_of(
      config_.takes, [&subject](const Selection& one) { return one.has(subject); });
  if (!is_wanted) return Refusal::kShape;
  return settle(subject.station, subject.region, subject.site, now.monotonic_s) ? Judged()
                                                                                : Refusal::kName;
}

Passage::Judged Passage::obey(const Subject& subject, const Headers& headers, const Now& now) {
  const std::uint64_t epoch = number(text_of(headers, kEpochHeader));
  const std::string target = text_of(headers, kTargetHeader);
  // Only those who lead a station compete; a stop by an operator concerns no owner.
  if (subject.command != "slew") return std::nullopt;
  return epochs_.passes(subject.station, target, epoch, now.monotonic_s) ? Judged()
                                                                         : Refusal::kEpoch;
}

// A name belongs to the place from which it is heard, until it falls silent: two stations of one
// name would be one to a fusion, and what came in would go out again.
bool Passage::settle(const std::string& station, const std::string& region, const std::string& site,
                     double now_s) {
  auto at = places_.find(station);
  if (at == places_.end()) {
    if (places_.size() >= kMostNames) return false;
    places_[station] = {region, site, now_s};
    return true;
  }
  Place& place = at->second;
  const bool is_same = place.region == region && place.site == site;
  if (!is_same && now_s - place.heard_s < kSettled_s) return false;
  place = {region, site, now_s};
  return true;
}

bool Passage::is_ours(const std::string& station) const {
  return config_.stations.empty() || std::ranges::count(config_.stations, station) > 0;
}

std::map<std::string, double> Passage::sites_ago_s(double now_s) const {
  std::map<std::string, double> ago;
  for (const auto& [station, place] : places_) {
    const double here = now_s - place.heard_s;
    if (here > kSettled_s) continue;
    const auto [at, is_new] = ago.try_emplace(place.site, here);
    if (!is_new) at->second = std::min(at->second, here);
  }
  return ago;
}

std::string Passage::channels() const {
  std::string wanted = config_.targets ? "OLS_TARGET" : "";
  const auto add = [&wanted](const std::string& more) {
    wanted.append(wanted.empty() ? "" : "|").append(more);
  };
  if (config_.role == Role::kSite) {
    add("OLS_(BEARING|STATUS)_" + regex_of(config_.stations));
    return wanted;
  }
  for (const std::string& command : config_.commands) {
    std::string name = channel_of({Kind::kCommand, "", "", "", command});
    add(name + ".*");
  }
  return wanted;
}

std::vector<std::string> Passage::subjects() const {
  std::vector<std::string> wanted;
  for (const Selection& one : config_.takes) {
    const std::string station = "ols.v1." + one.region + "." + one.site + "." + one.station;
    wanted.push_back(station + ".bearing");
    wanted.push_back(station + ".status");
  }
  if (config_.role == Role::kRegion) return wanted;
  for (const std::string& command : config_.commands) {
    const std::vector<std::string> one{"*"};
    for (const std::string& station : config_.stations.empty() ? one : config_.stations) {
      wanted.push_back("ols.v1." + config_.region + "." + config_.site + "." + station + ".cmd." +
                       command);
    }
  }
  return wanted;
}

}  // namespace ols::bridge
