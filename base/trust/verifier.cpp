#include "base/trust/verifier.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/channel_names.h"

namespace ols::trust {
namespace {

std::vector<RateLimit> fresh_rates() {
  std::vector<RateLimit> rates;
  for (const ChannelRule& rule : rules()) rates.emplace_back(rule.rate_hz);
  return rates;
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
  std::vector<std::uint8_t> text{};  // that is signed, and the signature: what the tag covers
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
    members[id] = {member, before == members_.end() ? fresh_rates() : before->second.rates};
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

// Only an order to the unit may name no boot, and of these the station obeys stops alone: a stop
// must not wait for the station's status.
std::optional<Distrust> Verifier::judge_address(Judged& judged) const {
  const bool mine = judged.channel.rule->is_command && !config_.station.empty() &&
                    judged.channel.station == config_.station;
  if (!mine) return std::nullopt;
  const std::int64_t audience = judged.message.trailer.audience;
  judged.addressed = audience == config_.boot_id && audience != 0;
  const bool may_stop = audience == 0 && judged.channel.rule->name == kPtuChannel;
  if (!judged.addressed && !may_stop) return Distrust::kOtherBoot;
  return std::nullopt;
}

// What names this boot is fresh by that; its lease is the station's to judge.
std::optional<Distrust> Verifier::judge_time(const Judged& judged) const {
  const ChannelRule& rule = *judged.channel.rule;
  const bool is_status = rule.name == kStatusChannel;
  const bool must_be_fresh = is_status ? !config_.takes_stale_statuses : rule.must_be_fresh;
  const bool fresh =
      judged.head.utime_us > 0 &&
      std::abs(judged.head.utime_us - judged.arrival.utime_us) <= config_.clock_tolerance_us;
  if (must_be_fresh && !judged.addressed && !fresh) return Distrust::kStale;
  if (rule.head != HeadForm::kUtimeOnly &&
      marks_.is_replayed(judged.message.trailer.key, std::string(judged.channel_name),
                         judged.head)) {
    return Distrust::kReplayed;
  }
  return std::nullopt;
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
  RateLimit& rate = judged.sender->rates[judged.channel.rule->index];
  if (!rate.has(arrival.monotonic_s)) return {Distrust::kRate, sender};
  const Bytes text = Bytes(judged.text).first(judged.text.size() - sizeof(Signature));
  if (!is_signed_by(judged.sender->member.key, text, split->trailer.signature)) {
    return {Distrust::kSignature, sender};
  }
  rate.spend();
  if (judged.channel.rule->head != HeadForm::kUtimeOnly) {
    marks_.note(split->trailer.key, std::string(channel), judged.head);
  }
  return {std::nullopt, sender, judged.addressed, judged.channel.rule, judged.head};
}

}  // namespace ols::trust
