#include "bridge/passage.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "base/trust/channel_rules.h"
#include "base/trust/trailer.h"
#include "conditions/refusal.h"

namespace ols::bridge {
namespace {

// The fusion's commands; the others are an operator's.
bool concerns_target(std::string_view command) {
  return command == "slew" || command == "occlusion";
}
constexpr double kFuture_s = 1.0;
constexpr double kRecent_s = 10.0;
constexpr double kMostOfOne_Hz = 400.0;
constexpr std::size_t kLongestWord = 100;
constexpr std::size_t kLargestStatus = 32'000, kLargest = 8'000;

std::string regex_of(const std::vector<std::string>& names) {
  if (names.empty()) return ".*";
  std::string regex = "(";
  for (const std::string& name : names) regex.append(regex.size() > 1 ? "|" : "").append(name);
  return regex + ")";
}

// A boot numbers its messages of each kind separately, and one stream holds several kinds.
std::string id_of(const Content& content, const trust::MessageHead& head) {
  const std::string who = content.kind == Kind::kTarget ? "target" : content.station;
  const std::string id =
      who + ":" + std::to_string(head.boot_id) + ":" + std::to_string(head.sequence);
  const std::string_view word = report_word(content.kind);
  return word.empty() || content.kind == Kind::kBearing ? id : id + ":" + std::string(word);
}

// A bridge's word: the name of a fusion with its start, or a number.
bool is_word(const std::string& text) {
  return text.size() <= kLongestWord && std::ranges::all_of(text, [](unsigned char c) {
           return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '=';
         });
}

void put(const Grant& grant, Headers& headers) {
  if (grant.id.empty()) return;
  headers[kTargetHeader] = grant.id;
  headers[kOwnerHeader] = grant.owner;
  headers[kEpochHeader] = std::to_string(grant.epoch);
  if (!grant.is_confirmed) headers[kUnconfirmedHeader] = "1";
}

void count(Counts& counts, const std::optional<Refusal>& refusal, std::string_view what) {
  if (!refusal) {
    ++counts.passed;
    return;
  }
  ++counts.refused.at(static_cast<std::size_t>(*refusal));
  // Both are normal: a bus gives back what was put onto it, and a fusion goes on with targets that
  // another one owns.
  if (*refusal == Refusal::kOwn || *refusal == Refusal::kNotOwned) return;
  counts.last_refusal =
      std::string(what.substr(0, 120)) + ": " + refusal_words(to_string(*refusal), "bridge_");
}

}  // namespace

// Anybody may have written the headers.
std::optional<Claim> claim_of(const Headers& headers) {
  const auto text_of = [&headers](const char* name) {
    const auto at = headers.find(name);
    return at == headers.end() ? "" : at->second;
  };
  Claim claim{text_of(kTargetHeader), text_of(kOwnerHeader)};
  if (!is_word(claim.target) || !is_word(claim.owner)) return std::nullopt;
  const auto epoch = headers.find(kEpochHeader);
  if (epoch == headers.end()) return claim;
  const char* const end = epoch->second.data() + epoch->second.size();
  const auto [last, error] = std::from_chars(epoch->second.data(), end, claim.epoch);
  return error == std::errc() && last == end ? std::optional(claim) : std::nullopt;
}

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
  if (const Judged refusal = judge_form(*content, channel, bytes, head)) return refusal;
  if (!settles(subject, now)) return Refusal::kName;
  if (const Judged refusal = judge_rate(*content, channel, now)) return refusal;
  // Live messages may be late on their way out, because the server's stream keeps all of them.
  const bool is_command = content->kind == Kind::kCommand;
  if (const Judged refusal = is_command ? judge_age(*content, head, now) : Judged()) return refusal;
  const bool is_owned = content->kind == Kind::kTarget || concerns_target(content->command);
  if (is_owned && owned) {
    const auto grant = owned(content->kind, trust::without_trailer(bytes));
    if (!grant) return Refusal::kNotOwned;
    put(*grant, outgoing.headers);
  }
  // Commands are never stored, so they need no id against storing them twice.
  if (!is_command) outgoing.headers[kIdHeader] = id_of(*content, head);
  outgoing.subject = to_text(subject);
  return std::nullopt;
}

Passage::Judged Passage::address(const Content& content, const Now& now, Subject& subject) {
  if (content.kind == Kind::kTarget) {
    subject = {Kind::kTarget, config_.region};
    return config_.targets ? Judged() : Refusal::kShape;
  }
  if (content.kind == Kind::kCommand) {
    const StationPlaces::Place* const place = places_.find(content.station);
    const bool crosses = std::ranges::count(config_.commands, content.command) > 0;
    if (config_.role != Role::kRegion || !crosses) return Refusal::kShape;
    if (place == nullptr) return Refusal::kNobody;
    subject.region = place->region;
    subject.site = place->site;
    return std::nullopt;
  }
  if (config_.role != Role::kSite) return Refusal::kShape;
  if (!is_ours(content.station)) return Refusal::kName;
  return places_.is_elsewhere(content.station, config_.region, config_.site, now.monotonic_s)
             ? Refusal::kOwn
             : Judged();
}

// Before anything of the message is remembered.
Passage::Judged Passage::judge_form(const Content& content, std::string_view channel, Bytes bytes,
                                    trust::MessageHead& head) {
  if (bytes.size() > (content.kind == Kind::kStatus ? kLargestStatus : kLargest)) {
    return Refusal::kSize;
  }
  const trust::ChannelRule& rule = *trust::rule_of(channel)->rule;
  const auto read = trust::read_head(trust::without_trailer(bytes), rule.head);
  if (!read) return Refusal::kMalformed;
  head = *read;
  if (rule.head == trust::HeadForm::kStationFirst && head.station != content.station) {
    return Refusal::kName;
  }
  return std::nullopt;
}

// Whether the station's name belongs to this place; a new name does from now on.
bool Passage::settles(const Subject& subject, const Now& now) {
  if (subject.kind == Kind::kCommand || subject.kind == Kind::kTarget) return true;
  return places_.settle(subject.station, subject.region, subject.site, now.monotonic_s);
}

Passage::Judged Passage::judge_rate(const Content& content, std::string_view channel,
                                    const Now& now) {
  const double most_hz = trust::rule_of(channel)->rule->rate_hz;
  ChannelRateLimits& rates = content.kind == Kind::kCommand ? command_rates_ : rates_;
  const double limit_hz = content.station.empty() ? most_hz : std::min(most_hz, kMostOfOne_Hz);
  return rates.passes(channel, limit_hz, now.monotonic_s) ? Judged() : Refusal::kRate;
}

// The age counts whatever buffer has held the message: of a link, a server or a system. A stamp
// ahead of this host's clock matters only in a command; the fusion judges those of bearings.
Passage::Judged Passage::judge_age(const Content& content, const trust::MessageHead& head,
                                   const Now& now) {
  // In floating point: a hostile stamp must not overflow.
  const double age_s =
      1e-6 * (static_cast<double>(now.utime_us) - static_cast<double>(head.utime_us));
  if (content.kind == Kind::kCommand) {
    return age_s <= config_.command_age_s && age_s >= -kFuture_s ? Judged() : Refusal::kStale;
  }
  if (age_s <= config_.live_age_s) return std::nullopt;
  late_ = content.kind == Kind::kTarget ? "a target" : content.station;
  late_.append(", ").append(std::to_string(std::llround(age_s))).append(" s");
  late_s_ = now.monotonic_s;
  return Refusal::kStale;
}

std::string Passage::late(double now_s) const { return now_s - late_s_ <= kRecent_s ? late_ : ""; }

bool Passage::hears_target(std::string_view subject, Bytes bytes, const Now& now) {
  const Content content{Kind::kTarget, {}, {}};
  trust::MessageHead head;
  Judged refusal = judge_form(content, channel_of({Kind::kTarget, {}}), bytes, head);
  if (!refusal) refusal = judge_age(content, head, now);
  if (refusal) count(in_, refusal, subject);
  return !refusal;
}

Passage::Judged Passage::judge_in(std::string_view text, const Headers& headers, Bytes bytes,
                                  const Now& now, std::string& channel) {
  const auto subject = parse_subject(text);
  if (!subject || subject->kind == Kind::kTarget) return Refusal::kShape;
  const Content content{subject->kind, subject->station, subject->command};
  channel = channel_of(*subject);
  if (const Judged refusal = take(*subject, now)) return refusal;
  trust::MessageHead head;
  if (const Judged refusal = judge_form(content, channel, bytes, head)) return refusal;
  if (!settles(*subject, now)) return Refusal::kName;
  if (const Judged refusal = judge_rate(content, channel, now)) return refusal;
  if (subject->kind == Kind::kCommand) {
    const Judged refusal = judge_age(content, head, now);
    return refusal ? refusal : obey(*subject, headers, now);
  }
  const std::string kind =
      subject->kind == Kind::kBearing ? "" : " (" + std::string(report_word(subject->kind)) + ")";
  gaps_.hear(subject->station + kind, head.boot_id, head.sequence, now.monotonic_s);
  return judge_age(content, head, now);
}

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
  return places_.is_elsewhere(subject.station, subject.region, subject.site, now.monotonic_s)
             ? Refusal::kName
             : Judged();
}

Passage::Judged Passage::obey(const Subject& subject, const Headers& headers, const Now& now) {
  // Only those who lead a station compete; a stop by an operator concerns no owner.
  if (!concerns_target(subject.command)) return std::nullopt;
  const auto claim = claim_of(headers);
  if (!claim) return Refusal::kMalformed;
  return epochs_.passes(subject.station, *claim, now.monotonic_s) ? Judged() : Refusal::kEpoch;
}

bool Passage::is_ours(const std::string& station) const {
  return config_.stations.empty() || std::ranges::count(config_.stations, station) > 0;
}

std::string Passage::channels() const {
  std::string wanted = config_.targets ? "OLS_TARGET" : "";
  const auto add = [&wanted](const std::string& more) {
    wanted.append(wanted.empty() ? "" : "|").append(more);
  };
  if (config_.role == Role::kSite) {
    add("OLS_(BEARING|STATUS|REPLY|SKYLINE)_" + regex_of(config_.stations));
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
    for (const std::string& report : reports()) wanted.push_back(station + "." + report);
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
