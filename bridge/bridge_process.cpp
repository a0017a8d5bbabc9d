#include "bridge/bridge_process.h"

#include <utility>

#include "base/bus/boot_id.h"
#include "base/journal/journal.h"
#include "base/process/clocks.h"
#include "base/process/service_frame.h"
#include "base/process/service_notifier.h"
#include "base/trust/trailer.h"
#include "bridge/messages.h"

namespace ols::bridge {
namespace {

constexpr int kTurn_ms = 20;
constexpr double kStatus_s = 1.0, kStep_s = 0.05;
constexpr double kShortest_s = 3.0;  // of a link: a server that refuses us is not flooded
constexpr double kStanding_s = 30.0;

Now now() { return {clock_utime_us(), clock_monotonic_s()}; }

std::string name_of(const BridgeConfig& config) {
  return "ols-bridge " + config.region + (config.role == Role::kSite ? "." + config.site : "");
}

// An owner is a fusion and its start, because a fusion that starts again does not know what it
// owned. The name becomes part of a key of the store.
std::optional<Ownership> make_ownership(const BridgeConfig& config) {
  if (!config.ownership.is_on) return std::nullopt;
  OwnershipRules rules;
  const std::string& name = config.ownership.name;
  rules.name = (name.empty() ? config.region : name) + "=" + std::to_string(draw_boot_id());
  rules.cell_deg = config.ownership.cell_deg;
  rules.margin_m = config.ownership.margin_m;
  return Ownership(rules);
}

std::vector<std::string> subjects_of(const Passage& passage, const BridgeConfig& config) {
  std::vector<std::string> subjects = passage.subjects();
  if (config.ownership.is_on) subjects.emplace_back("ols.v1.*.target");
  return subjects;
}

std::unique_ptr<ArchiveStream> make_archive(NatsLink& link, const BridgeConfig& config) {
  const auto plan = plan_stream(config);
  return plan ? std::make_unique<ArchiveStream>(link, *plan, config) : nullptr;
}

LinkReport sum(const LinkReport& before, LinkReport now) {
  now.openings += before.openings;
  now.losses += before.losses;
  now.sent += before.sent;
  now.unsent += before.unsent;
  now.displaced += before.displaced;
  now.refusals += before.refusals;
  return now;
}

}  // namespace

BridgeProcess::BridgeProcess(const BridgeConfig& config)
    : config_(config),
      status_file_(config.status_file),
      passage_(passage_of(config)),
      ownership_(make_ownership(config)),
      bus_(config.lcm_url, passage_.channels(),
           [this](const std::string& channel, Bytes bytes) { send_out(channel, bytes); }),
      remote_(std::make_unique<Remote>(*this, config_)) {}

BridgeProcess::Remote::Remote(BridgeProcess& bridge, const BridgeConfig& config)
    : link(config.nats, name_of(config), subjects_of(bridge.passage_, config),
           [&bridge](std::string_view subject, const Headers& headers, Bytes bytes) {
             bridge.take_in(subject, headers, bytes);
           }),
      archive(make_archive(link, config)),
      begun_s(clock_monotonic_s()) {
  if (!bridge.ownership_) return;
  store = std::make_unique<OwnerStore>(link, config.ownership.domain, bridge.ears());
}

// A connection that has ended is made anew. Everything else stays: where stations are, whom they
// obey, what this fusion owns, and every count.
void BridgeProcess::renew_link(double now_s) {
  const LinkReport link = remote_->link.report();
  if (link.is_open) tried_anew_.clear();
  if (!link.has_ended || now_s - remote_->begun_s < kShortest_s) return;
  if (tried_anew_ != link.trouble) {
    write_to_journal({.text = "the server is tried anew: " + link.trouble,
                      .bad = true,
                      .id = event::kLineFails,
                      .device = "server",
                      .reason = link.trouble});
  }
  tried_anew_ = link.trouble;
  before_ = sum(before_, link);
  remote_.reset();
  if (ownership_) {
    const std::lock_guard lock(mutex_);
    ownership_->feel_store(false, now());
  }
  remote_ = std::make_unique<Remote>(*this, config_);
}

OwnerStore::Ears BridgeProcess::ears() {
  OwnerStore::Ears ears;
  ears.learn = [this](const std::string& target, const OwnerRecord& record,
                      std::uint64_t revision) {
    const std::lock_guard lock(mutex_);
    ownership_->learn(target, record, revision, now());
  };
  ears.gone = [this](const std::string& target) {
    const std::lock_guard lock(mutex_);
    ownership_->learn_gone(target, now());
  };
  ears.wish = [this](const std::string& target, const std::string& by, std::uint64_t revision) {
    const std::lock_guard lock(mutex_);
    ownership_->learn_wish(target, by, revision, now());
  };
  ears.answer = [this](const StoreRequest& request, StoreAnswer answer, std::uint64_t revision) {
    const std::lock_guard lock(mutex_);
    ownership_->answer(request, answer, revision, now());
  };
  ears.feel = [this](bool answers) {
    const std::lock_guard lock(mutex_);
    ownership_->feel_store(answers, now());
  };
  return ears;
}

// Called under the lock, for each outgoing target, and for each outgoing command that concerns one.
Owned BridgeProcess::owned() {
  if (!ownership_) return {};
  return [this](Kind kind, Bytes payload) -> std::optional<Grant> {
    const auto target = target_id_of(kind, payload);
    if (!target) return std::nullopt;
    if (*target == 0) {
      // A search concerns no target that another fusion could own. That there is no target does not
      // go out: every region would say so.
      return kind == Kind::kCommand ? std::optional(Grant{}) : std::nullopt;
    }
    if (kind == Kind::kTarget) {
      if (const auto track = track_from(payload)) ownership_->hear(*track, now());
    }
    return ownership_->grant(*target, now());
  };
}

// What other owners publish tells where their targets are, and the epochs of their ownership.
void BridgeProcess::hear_owner(std::string_view subject, const Headers& headers, Bytes bytes) {
  const auto sighting = sighting_from(headers, trust::without_trailer(bytes));
  if (!ownership_ || !sighting) return;
  const std::lock_guard lock(mutex_);
  if (!passage_.hears_target(subject, bytes, now())) return;
  ownership_->hear(*sighting, now());
}

void BridgeProcess::step_ownership() {
  if (!ownership_) return;
  std::vector<StoreRequest> requests;
  {
    const std::lock_guard lock(mutex_);
    requests = ownership_->step(now());
  }
  if (!requests.empty()) remote_->store->ask(std::move(requests));
}

void BridgeProcess::send_out(const std::string& channel, Bytes bytes) {
  std::optional<Outgoing> outgoing;
  {
    const std::lock_guard lock(mutex_);
    outgoing = passage_.out(channel, bytes, now(), owned());
  }
  if (outgoing) remote_->link.send(*outgoing, bytes);
}

void BridgeProcess::take_in(std::string_view subject, const Headers& headers, Bytes bytes) {
  if (subject.ends_with(".target")) {
    hear_owner(subject, headers, bytes);
    return;
  }
  std::optional<std::string> channel;
  {
    const std::lock_guard lock(mutex_);
    channel = passage_.in(subject, headers, bytes, now());
  }
  if (channel && !bus_.send(*channel, bytes)) ++unsent_to_bus_;
}

void BridgeProcess::describe_link(BridgeStatus& status) const {
  const LinkReport link = sum(before_, remote_->link.report());
  status.link = {link.is_open, link.trouble,   link.openings, link.losses, link.sent,
                 link.unsent,  link.displaced, link.refusals, link.refusal};
}

void BridgeProcess::describe_archive(BridgeStatus& status, std::map<std::string, double> heard,
                                     double now_s) {
  status.archive.is_wanted = remote_->archive != nullptr;
  if (!remote_->archive) return;
  const ArchiveReport seen = remote_->archive->report();
  status.archive.is_kept = seen.is_kept;
  status.archive.trouble = seen.trouble;
  status.archive.messages = seen.messages;
  status.archive.bytes = seen.bytes;
  // The first messages of a site take a moment until they are copied.
  std::erase_if(live_since_s_, [&heard](const auto& one) { return !heard.contains(one.first); });
  std::erase_if(heard, [this, now_s](const auto& one) {
    const double since_s = live_since_s_.try_emplace(one.first, now_s).first->second;
    return now_s - since_s < kStanding_s;
  });
  std::map<std::string, double> archived;
  for (const SourceReport& source : seen.sources) {
    archived[source.site] = 1e-6 * static_cast<double>(status.utime_us - source.newest_utime_us);
  }
  status.archive.standing = standing_still(heard, archived, kStanding_s);
}

BridgeStatus BridgeProcess::status() {
  BridgeStatus status;
  const Now at = now();
  status.utime_us = at.utime_us;
  status.bus_alarms = bus_.all_alarms(at.monotonic_s);
  bus_.count(status.bus_counters);
  status.unsent_to_bus = unsent_to_bus_;
  describe_link(status);
  std::map<std::string, double> heard;
  {
    const std::lock_guard lock(mutex_);
    status.stations = passage_.stations();
    status.out = passage_.out_counts();
    status.in = passage_.in_counts();
    status.missing = passage_.gaps().missing();
    status.repeated = passage_.gaps().repeated();
    status.gap = passage_.gaps().alarm(at.monotonic_s);
    status.late = passage_.late(at.monotonic_s);
    status.obeyed_epoch = passage_.greatest_epoch();
    heard = passage_.sites_ago_s(at.monotonic_s);
    if (ownership_) {
      const Ownership::Counts own = ownership_->counts(at);
      status.ownership = {true,      own.is_confirmed, own.owned, own.others,
                          own.taken, own.handed_over,  own.lost,  own.epoch};
    }
  }
  if (remote_->store) status.ownership.delay_s = remote_->store->delay_s();
  describe_archive(status, std::move(heard), at.monotonic_s);
  return status;
}

std::string BridgeProcess::report() {
  const BridgeStatus seen = status();
  alarms_.look(alarms(seen), clock_monotonic_s());
  status_file_.write(to_json(seen));
  return in_one_line(seen);
}

void BridgeProcess::run() {
  bus_.connect(clock_monotonic_s(), BusConnector::kLongest_s);
  ServiceNotifier service_manager;
  service_manager.ready("bridge");
  write_to_journal({.text = "ready", .id = event::kReady});
  double step_due_s = 0.0;
  const auto turn = [&](double now_s) {
    bus_.turn(now_s, kTurn_ms);
    if (now_s < step_due_s) return;
    step_due_s = now_s + kStep_s;
    step_ownership();
    renew_link(now_s);
  };
  serve(service_manager, kStatus_s, turn, [this] { return report(); });
}

}  // namespace ols::bridge
