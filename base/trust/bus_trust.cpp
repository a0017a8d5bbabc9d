#include "base/trust/bus_trust.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <system_error>

#include "base/bus/channel_names.h"
#include "base/config/toml_config.h"
#include "base/files/atomic_file.h"
#include "base/files/small_file.h"
#include "base/trust/messages_trust.h"
#include "conditions/alarms.h"

namespace ols::trust {
namespace {

constexpr auto kLook = std::chrono::seconds(1);
constexpr int kKeepEvery = 5;  // looks, from one writing of the marks to the next
constexpr std::size_t kLargestFile = 20'000'000;

std::string from_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Empty if it is not there or cannot be read.
std::string text_if_any(const std::string& path) {
  try {
    return path.empty() ? "" : read_small_file(path, kLargestFile);
  } catch (const std::system_error&) {
    return "";
  }
}

void replace_file(const std::string& path, const std::string& text) {
  AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

MemberKey key_of(const std::string& path) {
  try {
    return read_member_key(path);
  } catch (const std::system_error& problem) {
    throw ConfigError("trust.key: " + std::string(problem.what()) +
                      "; ols-key enrol makes it (docs/security.md)");
  }
}

SiteFiles site_files(const TrustConfig& config, const Environment& environment,
                     const std::string& name) {
  return {settings_path(config, environment), kept_path(environment, "site", name)};
}

// systemd names all folders of StateDirectory=, with colons between them.
std::string first_of(const std::string& folders) { return folders.substr(0, folders.find(':')); }

std::string marks_path(const Environment& environment, const Self& self) {
  if (!self.keeps_marks || environment.state.empty()) return "";
  return environment.state + "/heard-" + self.name;
}

}  // namespace

Environment process_environment() {
  return {from_environment("OLS_TRUST"), from_environment("OLS_KEYS"),
          from_environment("CREDENTIALS_DIRECTORY"), first_of(from_environment("STATE_DIRECTORY"))};
}

SiteSettings settings_at_start(const TrustConfig& config, const Environment& environment,
                               const std::string& name, const SettingsCheck& check) {
  try {
    if (mode_of(config, environment) == Mode::kOff) return {};
    const MemberKey key = read_member_key(key_path(config, environment, name));
    return SiteKeeper(key.root, site_files(config, environment, name), check).settings();
  } catch (const std::exception&) {
    return {};  // BusTrust::open() reports it
  }
}

std::shared_ptr<BusTrust> BusTrust::open(const TrustConfig& config, const Environment& environment,
                                         const Self& self) {
  Mode mode = Mode::kOff;
  try {
    mode = mode_of(config, environment);
  } catch (const std::invalid_argument& problem) {
    throw ConfigError(problem.what());
  }
  if (mode == Mode::kOff) return nullptr;
  std::shared_ptr<BusTrust> trust(new BusTrust(mode, config, environment, self));
  trust->begin();
  return trust;
}

BusTrust::BusTrust(Mode mode, const TrustConfig& config, const Environment& environment,
                   const Self& self)
    : mode_(mode),
      self_(self),
      key_(key_of(key_path(config, environment, self.name))),
      tolerance_us_(static_cast<std::int64_t>(config.clock_tolerance_s * 1e6)),
      site_(key_.file.root, site_files(config, environment, self.name), self.settings),
      marks_file_(marks_path(environment, self)) {
  if (self.is_station && key_.file.name != self.name) {
    throw ConfigError("trust.key: is that of " + key_.file.name + ", not of " + self.name);
  }
  files_.list = list_path(config, environment);
  files_.must_be_there = !config.list.empty();
  files_.kept_list = kept_path(environment, "trust", self.name);
}

void BusTrust::begin() {
  try {
    files_.read = read_small_file(files_.list, kLargestFile);
    offer(files_.read, files_.list);
  } catch (const std::system_error& problem) {
    const bool missing = problem.code() == std::errc::no_such_file_or_directory;
    if (!missing || files_.must_be_there) {
      throw ConfigError("trust.list: " + std::string(problem.what()));
    }
    TrustList nobody;
    nobody.root = key_.file.root;
    adopt(nobody, "");
  }
  try {
    const std::string kept = text_if_any(files_.kept_list);
    if (!kept.empty()) offer(kept, files_.kept_list);
  } catch (const ConfigError&) {
    // A list of another site, or a damaged one: the next list replaces it.
  }
  files_.number = list_.number;
  marks_file_.read(verifier_->marks());
  watcher_.thread = std::thread([this] { watch(); });
}

BusTrust::~BusTrust() {
  {
    const std::lock_guard lock(mutex_);
    watcher_.ends = true;
  }
  watcher_.end.notify_all();
  if (watcher_.thread.joinable()) watcher_.thread.join();
}

bool BusTrust::offer(const std::string& text, const std::string& name) {
  return adopt(read_list(text, name, key_.file.root), text);
}

bool BusTrust::adopt(const TrustList& list, const std::string& text) {
  if (!replace(list, text)) return false;
  if (self_.list_taken && list.number > 0) self_.list_taken(list);
  return true;
}

bool BusTrust::replace(const TrustList& list, const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (verifier_ && list.number <= list_.number) return false;
  list_ = list;
  text_ = text;
  if (verifier_) {
    verifier_->adopt(list_);
    return true;
  }
  Verifier::Config config;
  if (self_.is_station) config.station = self_.name;
  config.boot_id = self_.boot_id;
  config.clock_tolerance_us = tolerance_us_;
  config.takes_stale_statuses = self_.commands;
  config.is_stop = is_stop;
  verifier_.emplace(config, key_.file.site_key, list_);
  return true;
}

std::vector<std::uint8_t> BusTrust::sign(const std::string& channel, Bytes payload) {
  std::int64_t audience = 0;
  if (const auto rule = rule_of(channel); rule && rule->rule->is_command) {
    const std::lock_guard lock(mutex_);
    audience = boots_.boot_of(rule->station);
  }
  return with_trailer(key_.signing, key_.file.site_key, channel, payload, audience);
}

bool BusTrust::wants(std::string_view channel) const {
  return channel == kTrustChannel || channel == kSiteChannel ||
         (!self_.is_station &&
          (channel.starts_with(kStatusChannel) || channel.starts_with(kReplyChannel)));
}

BusTrust::Learned BusTrust::judge_and_learn(std::string_view channel, Bytes message,
                                            const Arrival& arrival) {
  const std::lock_guard lock(mutex_);
  auto verdict = verifier_->judge(channel, message, arrival);
  const bool tells_boot = !verdict.distrust && (verdict.rule->name == kStatusChannel ||
                                                verdict.rule->name == kReplyChannel);
  if (tells_boot) {
    const bool fresh = verdict.head.utime_us > 0 &&
                       std::abs(verdict.head.utime_us - arrival.utime_us) <= tolerance_us_;
    boots_.hear(verdict.head.station, verdict.head.boot_id, fresh, arrival.monotonic_s);
  }
  return {verdict, list_.number};
}

// Anybody who has the site's secret may pass the list on, because only the root's signature on it
// counts. A new member knows no other member yet, and one that was off knows no key that was
// exchanged since.
bool BusTrust::is_of_site(std::string_view channel, Bytes message) const {
  const auto split = split_trailer(message);
  return split && has_site_tag(key_.file.site_key, channel, *split);
}

Judgement BusTrust::judge(std::string_view channel, Bytes message, std::int64_t utime_us,
                          double now_s) {
  const Arrival arrival{utime_us, now_s};
  Learned learned = judge_and_learn(channel, message, arrival);
  const bool of_member = !learned.verdict.distrust;
  if (channel == kTrustChannel && (of_member || is_of_site(channel, message))) {
    const bool is_new = hear_list(without_trailer(message), of_member, now_s);
    // This list may make its sender a member.
    if (is_new && !of_member) learned = judge_and_learn(channel, message, arrival);
  }
  const Verifier::Verdict& verdict = learned.verdict;
  if (!verdict.distrust && channel == kSiteChannel) {
    if (const auto text = settings_from(without_trailer(message))) site_.hear(*text);
  }
  Judgement judgement{without_trailer(message)};
  judgement.distrust = verdict.distrust;
  judgement.sender = verdict.sender;
  judgement.list_number = learned.list_number;
  if (mode_ != Mode::kRequire) return judgement;
  judgement.passes = !verdict.distrust;
  judgement.addressed = verdict.addressed;
  return judgement;
}

// A list that no root has signed is reported if its sender is a member; a stranger's is only
// counted, with its message.
bool BusTrust::hear_list(Bytes payload, bool from_member, double now_s) {
  const auto text = list_from(payload);
  if (!text) return false;
  {
    const std::lock_guard lock(mutex_);
    if (*text == text_) return false;
    if (!from_member) {
      if (!telling_.strangers.has(now_s)) return false;
      telling_.strangers.spend();
    }
  }
  try {
    const TrustList list = read_list(*text, "OLS_TRUST", key_.file.root);
    if (adopt(list, *text)) return true;
    const std::lock_guard lock(mutex_);
    if (from_member && list.number < list_.number) telling_.answers = true;
    return false;
  } catch (const ConfigError& problem) {
    const std::lock_guard lock(mutex_);
    if (from_member) trouble_.file = problem.what();
    return false;
  }
}

std::optional<std::string> BusTrust::list_to_tell(double now_s) {
  const std::lock_guard lock(mutex_);
  if (!self_.tells_list && !telling_.answers) return std::nullopt;
  if (now_s < telling_.due_s || text_.empty() || text_.size() > kLargestList) return std::nullopt;
  telling_.due_s = now_s + kTell_s;
  telling_.answers = false;
  return text_;
}

std::optional<std::string> BusTrust::settings_to_tell(double now_s) {
  return self_.tells_list ? site_.to_tell(now_s) : std::nullopt;
}

std::string BusTrust::list_text() const {
  const std::lock_guard lock(mutex_);
  return text_;
}

std::vector<std::string> BusTrust::stations() const {
  const std::lock_guard lock(mutex_);
  return list_.stations();
}

std::int64_t BusTrust::list_number() const {
  const std::lock_guard lock(mutex_);
  return list_.number;
}

std::optional<std::vector<std::uint8_t>> BusTrust::list_telling(std::int64_t utime_us) {
  std::string text;
  {
    const std::lock_guard lock(mutex_);
    const Member* own = own_entry();
    if (own == nullptr || own->revoked) return std::nullopt;
    text = text_;
  }
  const auto message = to_message(text, self_.boot_id, utime_us, utime_us);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return sign(std::string(kTrustChannel), bytes);
}

Alarm BusTrust::trouble() const {
  for (const Alarm& one : {membership_trouble(), marks_file_.trouble(), site_.trouble()}) {
    if (!one.empty()) return one;
  }
  return {};
}

// Null: not in the list. Under the lock.
const Member* BusTrust::own_entry() const {
  const auto own = std::ranges::find(list_.members, key_.signing.public_key(), &Member::key);
  return own == list_.members.end() ? nullptr : &*own;
}

Alarm BusTrust::membership_trouble() const {
  const std::lock_guard lock(mutex_);
  if (!trouble_.file.empty()) return alarm::trust_list_unusable(trouble_.file);
  if (list_.number == 0) return alarm::no_trust_list(key_.file.name);
  const Member* own = own_entry();
  if (own == nullptr) return alarm::own_key_not_in_list(key_.file.name, list_.number);
  if (own->revoked) return alarm::own_key_revoked(own->name);
  const std::string strange = list_.strange_members();
  if (!strange.empty()) return alarm::trust_roles_unknown(strange);
  return trouble_.keeping.empty() ? Alarm() : alarm::trust_list_unsaved(trouble_.keeping);
}

void BusTrust::watch() {
  for (int look = 1;; ++look) {
    bool ends = false;
    {
      std::unique_lock lock(mutex_);
      ends = watcher_.end.wait_for(lock, kLook, [this] { return watcher_.ends; });
    }
    if (!ends) look_at_file();
    site_.look();
    marks_file_.look();
    if (ends || look % kKeepEvery == 0) keep();
    if (ends) return;
  }
}

void BusTrust::look_at_file() {
  std::string trouble;
  try {
    const std::string text = read_small_file(files_.list, kLargestFile);
    if (text != files_.read) offer(text, files_.list);
    files_.read = text;
  } catch (const std::system_error& problem) {
    // If the file never existed, the list is received from the bus instead.
    if (!files_.read.empty()) trouble = problem.what();
  } catch (const std::exception& problem) {
    trouble = problem.what();
  }
  const std::lock_guard lock(mutex_);
  trouble_.file = trouble;
}

void BusTrust::keep() {
  std::string text, marks, trouble;
  std::int64_t number = 0;
  std::uint64_t revision = 0;
  {
    const std::lock_guard lock(mutex_);
    number = list_.number;
    revision = verifier_->marks().revision();
    if (number != files_.number) text = text_;
    if (marks_file_.is_behind(verifier_->marks())) marks = verifier_->marks().text();
  }
  try {
    if (!text.empty() && !files_.kept_list.empty()) replace_file(files_.kept_list, text);
    files_.number = number;
  } catch (const std::exception& problem) {
    trouble = problem.what();
  }
  if (!marks.empty()) marks_file_.write(marks, revision);
  const std::lock_guard lock(mutex_);
  trouble_.keeping = trouble;
}

}  // namespace ols::trust
