#include "base/trust/verifier.h"

#include <cstdlib>
#include <utility>

#include "base/bus/channel_names.h"

namespace ols::trust {
namespace {

constexpr double kStops_Hz = 500.0;  // each person who stops a station repeats it 50 times a second

std::vector<RateLimit> fresh_rates() {
  std::vector<RateLimit> rates;
  for (const ChannelRule& rule : rules()) rates.emplace_back(rule.rate_hz);
  return rates;
}

// Whether a station reports of itself, of its state or of an order, where its clock may be wrong.
bool is_own_account(const ChannelRule& rule) {
  return rule.name == kStatusChannel || rule.name == kReplyChannel;
}

}  // namespace

const char* to_string(Distrust reason) {
  switch (reason) {
    case Distrust::kUnsigned:
      return "unsigned";
    case Distrust::kStranger:
      return "stranger";
    case Distrust::kRevoked:
      return "revoked";
    case Distrust::kChannel:
      return "channel";
    case Distrust::kMalformed:
      return "malformed";
    case Distrust::kOtherBoot:
      return "other_boot";
    case Distrust::kStale:
      return "stale";
    case Distrust::kReplayed:
      return "replayed";
    case Distrust::kRate:
      return "rate";
    case Distrust::kSignature:
      return "signature";
    case Distrust::kCount:
      break;
  }
  return "unknown";
}

// What is known so far of a message that is being judged.
struct Verifier::Judged {
  std::string_view channel_name;
  Arrival arrival;
  SignedMessage message{};
  std::vector<std::uint8_t> text{};  // the signed text and the signature: what the tag covers
  Known* sender = nullptr;
  Channel channel{};
  MessageHead head{};
  bool addressed = false;
};

Verifier::Verifier(Config config, const std::optional<SiteKey>& site, const TrustList& list)
    : config_(std::move(config)), site_(site) {
  adopt(list);
}

void Verifier::adopt(const TrustList& list) {
  std::map<KeyId, Known> members;
  stations_.clear();
  for (const Member& member : list.members) {
    const KeyId id = key_id(member.key);
    const auto before = members_.find(id);
    if (before != members_.end()) {
      members[id] = {member, before->second.rates, before->second.station_rates};
    } else {
      members[id] = {member, fresh_rates()};
    }
    if (member.role == Role::kStation && !member.revoked) stations_[member.name] = true;
  }
  members_ = std::move(members);
}

bool Verifier::has_tag(const Judged& judged) const {
  return !site_ || site_tag(*site_, judged.text) == judged.message.trailer.tag;
}

std::optional<Distrust> Verifier::judge_origin(Judged& judged) {
  const Trailer& trailer = judged.message.trailer;
  const auto sender = members_.find(trailer.key);
  if (sender == members_.end()) return Distrust::kStranger;
  judged.text =
      signed_text(judged.channel_name, judged.message.payload, trailer.key, trailer.audience);
  judged.text.insert(judged.text.end(), trailer.signature.begin(), trailer.signature.end());
  if (!has_tag(judged)) return Distrust::kStranger;
  judged.sender = &sender->second;
  if (judged.sender->member.revoked) return Distrust::kRevoked;
  const auto channel = rule_of(judged.channel_name);
  if (!channel) return Distrust::kChannel;
  judged.channel = *channel;
  const Member& member = judged.sender->member;
  if (!may_send(member.role, member.name, *channel)) return Distrust::kChannel;
  const auto head = read_head(judged.message.payload, channel->rule->head);
  if (!head) return Distrust::kMalformed;
  judged.head = *head;
  const bool names_station =
      channel->rule->with_station && channel->rule->head != HeadForm::kUtimeOnly;
  if (names_station && !stations_.contains(channel->station)) return Distrust::kChannel;
  if (channel->rule->head == HeadForm::kStationFirst && head->station != channel->station) {
    return Distrust::kChannel;
  }
  return std::nullopt;
}

// An order may name no boot if its sender has not heard the station yet. Of these, the station
// obeys only stops. It answers the others, and the answer tells the sender the boot.
std::optional<Distrust> Verifier::judge_address(Judged& judged) const {
  const bool mine = judged.channel.rule->is_command && !config_.station.empty() &&
                    judged.channel.station == config_.station;
  if (!mine) return std::nullopt;
  const std::int64_t audience = judged.message.trailer.audience;
  judged.addressed = audience == config_.boot_id && audience != 0;
  const bool is_answered = audience == 0 && judged.channel.rule->sender != Role::kFusion;
  if (!judged.addressed && !is_answered) return Distrust::kOtherBoot;
  return std::nullopt;
}

bool Verifier::is_fresh(const Judged& judged) const {
  return judged.head.utime_us > 0 &&
         std::abs(judged.head.utime_us - judged.arrival.utime_us) <= config_.clock_tolerance_us;
}

// An order that names this boot is fresh by that; the station judges its lease.
std::optional<Distrust> Verifier::judge_time(const Judged& judged) const {
  const ChannelRule& rule = *judged.channel.rule;
  const bool may_be_stale =
      judged.addressed ||
      (is_own_account(rule) ? config_.takes_stale_statuses &&
                                  statuses_.may_be_own(judged.head.station, judged.head.boot_id,
                                                       judged.arrival.monotonic_s)
                            : !rule.must_be_fresh);
  if (!may_be_stale && !is_fresh(judged)) return Distrust::kStale;
  if (rule.head != HeadForm::kUtimeOnly && is_replayed(judged)) return Distrust::kReplayed;
  return std::nullopt;
}

bool Verifier::stops(const Judged& judged) const {
  return judged.channel.rule->name == kPtuChannel && config_.is_stop &&
         config_.is_stop(judged.message.payload);
}

// Each run of ols-ctl is a boot, so boots are soon forgotten. A stop must not be refused because a
// forgotten boot may have sent something later; nor must the status of a station whose clock is not
// set.
bool Verifier::is_replayed(const Judged& judged) const {
  const KeyId& key = judged.message.trailer.key;
  const std::string channel(judged.channel_name);
  if (!marks_.is_replayed(key, channel, judged.head)) return false;
  const bool may_be_earlier =
      is_fresh(judged) ? stops(judged) : is_own_account(*judged.channel.rule);
  return !may_be_earlier || marks_.is_heard(key, channel, judged.head);
}

// The stamp of a station whose clock is not set means nothing: once its boot is forgotten, a stamp
// from the future must not make later messages look stale.
void Verifier::note(const Judged& judged) {
  MessageHead head = judged.head;
  if (is_own_account(*judged.channel.rule) && !is_fresh(judged)) head.utime_us = 0;
  marks_.note(judged.message.trailer.key, std::string(judged.channel_name), head);
}

// The rate limits that the message counts for: that of its kind, and that towards its station.
// Stops have a limit of their own, so that a flood of other orders does not use it up.
std::vector<RateLimit*> Verifier::rates_of(const Judged& judged) const {
  const ChannelRule& rule = *judged.channel.rule;
  RateLimit& of_kind = judged.sender->rates[rule.index];
  if (rule.station_rate_hz <= 0.0) return {&of_kind};
  const bool stop = stops(judged);
  const std::tuple name(rule.index, stop, std::string(judged.channel.station));
  RateLimit& towards =
      judged.sender->station_rates.try_emplace(name, stop ? kStops_Hz : rule.station_rate_hz)
          .first->second;
  return stop ? std::vector{&towards} : std::vector{&of_kind, &towards};
}

Verifier::Verdict Verifier::judge(std::string_view channel, Bytes message, const Arrival& arrival) {
  const auto split = split_trailer(message);
  if (!split) return {Distrust::kUnsigned};
  Judged judged{channel, arrival, *split};
  auto distrust = judge_origin(judged);
  if (!distrust) distrust = judge_address(judged);
  if (!distrust) distrust = judge_time(judged);
  const std::string sender = judged.sender == nullptr ? "" : judged.sender->member.name;
  if (distrust) return {distrust, sender};
  const auto rates = rates_of(judged);
  for (RateLimit* rate : rates) {
    if (!rate->has(arrival.monotonic_s)) return {Distrust::kRate, sender};
  }
  const Bytes text = Bytes(judged.text).first(judged.text.size() - sizeof(Signature));
  if (!is_signed_by(judged.sender->member.key, text, split->trailer.signature)) {
    return {Distrust::kSignature, sender};
  }
  for (RateLimit* rate : rates) rate->spend();
  if (is_own_account(*judged.channel.rule)) {
    statuses_.hear(judged.head.station, judged.head.boot_id, is_fresh(judged), arrival.monotonic_s);
  }
  if (judged.channel.rule->head != HeadForm::kUtimeOnly) note(judged);
  return {std::nullopt, sender, judged.addressed, judged.channel.rule, judged.head};
}

}  // namespace ols::trust
