#include "bridge/owner_store.h"

#include <nats/nats.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/process/clocks.h"

namespace ols::bridge {
namespace {

constexpr const char* kBucket = "OLS_OWNERS";
constexpr std::int64_t kPatience_ms = 500, kWatch_ms = 200;
constexpr std::int64_t kKept_ns = 600'000'000'000;  // a record that nobody renews is then removed
constexpr std::size_t kMostRequests = 2000;
// A watcher ends silently if its server restarts behind another one. While targets are owned, there
// are five changes per lease.
constexpr double kDeaf_s = 3.0;
constexpr auto kProbe = std::chrono::milliseconds(300);
constexpr std::string_view kTarget = "target.", kWish = "wish.";

// kRefused: any status that says that the record is not as expected. All else is no answer.
StoreAnswer answer_of(natsStatus status) {
  switch (status) {
    case NATS_OK:
      return StoreAnswer::kDone;
    case NATS_ERR:
    case NATS_MISMATCH:
    case NATS_ILLEGAL_STATE:
      return StoreAnswer::kRefused;
    default:
      return StoreAnswer::kNone;
  }
}

}  // namespace

OwnerStore::OwnerStore(NatsLink& link, std::string domain, Ears ears)
    : link_(link), domain_(std::move(domain)), ears_(std::move(ears)) {
  worker_ = std::thread([this] { work(); });
}

OwnerStore::~OwnerStore() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  asked_.notify_all();
  worker_.join();
  if (watcher_.joinable()) watcher_.join();
  for (const Waiting& one : requests_) {
    if (!one.request.is_wish) ears_.answer(one.request, StoreAnswer::kNone, 0);
  }
  close();
}

void OwnerStore::close() {
  kvStore_Destroy(std::exchange(store_, nullptr));
  jsCtx_Destroy(std::exchange(js_, nullptr));
}

bool OwnerStore::open() {
  if (!link_.report().is_open) return false;
  jsOptions options;
  jsOptions_Init(&options);
  options.Wait = kPatience_ms;
  if (!domain_.empty()) options.Domain = domain_.c_str();
  if (natsConnection_JetStream(&js_, link_.connection(), &options) != NATS_OK) return false;
  kvConfig bucket;
  kvConfig_Init(&bucket);
  bucket.Bucket = kBucket;
  bucket.History = 1;
  bucket.TTL = kKept_ns;
  bucket.MaxValueSize = 1000;
  bucket.StorageType = js_FileStorage;
  if (js_KeyValue(&store_, js_, kBucket) == NATS_OK) return true;
  if (js_CreateKeyValue(&store_, js_, &bucket) == NATS_OK) return true;
  close();
  return false;
}

bool OwnerStore::probe() {
  kvEntry* entry = nullptr;
  const natsStatus status = kvStore_Get(&entry, store_, "probe");
  kvEntry_Destroy(entry);
  return status == NATS_OK || status == NATS_NOT_FOUND;
}

void OwnerStore::ask(std::vector<StoreRequest> requests) {
  std::vector<StoreRequest> too_many;
  {
    const std::lock_guard lock(mutex_);
    for (StoreRequest& request : requests) {
      if (requests_.size() < kMostRequests) {
        requests_.push_back({std::move(request), clock_monotonic_s()});
      } else if (!request.is_wish) {
        too_many.push_back(std::move(request));
      }
    }
  }
  asked_.notify_all();
  for (const StoreRequest& request : too_many) {
    ears_.answer(request, StoreAnswer::kNone, 0);
  }
}

double OwnerStore::delay_s() const {
  const std::lock_guard lock(mutex_);
  if (requests_.empty()) return last_delay_s_;
  return std::max(last_delay_s_, clock_monotonic_s() - requests_.front().asked_s);
}

void OwnerStore::work() {
  auto probe_due = std::chrono::steady_clock::now();
  while (!ends_) {
    if (std::chrono::steady_clock::now() >= probe_due) {
      if (store_ == nullptr && open()) watcher_ = std::thread([this] { watch(); });
      ears_.feel(store_ != nullptr && link_.report().is_open && probe());
      probe_due = std::chrono::steady_clock::now() + kProbe;
    }
    std::unique_lock lock(mutex_);
    asked_.wait_until(lock, probe_due, [this] { return ends_ || !requests_.empty(); });
    if (requests_.empty()) continue;
    const Waiting one = std::move(requests_.front());
    requests_.pop_front();
    lock.unlock();
    carry_out(one.request);
    lock.lock();
    last_delay_s_ = clock_monotonic_s() - one.asked_s;
  }
}

void OwnerStore::carry_out(const StoreRequest& request) {
  const bool is_open = store_ != nullptr && link_.report().is_open;
  if (request.is_wish) {
    const std::string key = std::string(kWish) + request.target;
    if (is_open) kvStore_PutString(nullptr, store_, key.c_str(), request.record.owner.c_str());
    return;
  }
  std::uint64_t revision = 0;
  natsStatus status = NATS_CONNECTION_DISCONNECTED;
  const std::string key = std::string(kTarget) + request.target;
  const std::string text = to_text(request.record);
  if (is_open && request.revision == 0) {
    status = kvStore_CreateString(&revision, store_, key.c_str(), text.c_str());
  } else if (is_open) {
    status = kvStore_UpdateString(&revision, store_, key.c_str(), text.c_str(), request.revision);
  }
  StoreAnswer answer = answer_of(status);
  if (answer == StoreAnswer::kRefused) answer = look_again(request);
  ears_.answer(request, answer, revision);
}

// Another fusion has written there, or the answer to our own write was lost. The present record is
// reported before the refusal, because the watcher may not have heard of it.
StoreAnswer OwnerStore::look_again(const StoreRequest& request) {
  const std::string key = std::string(kTarget) + request.target;
  kvEntry* entry = nullptr;
  const natsStatus status = kvStore_Get(&entry, store_, key.c_str());
  StoreAnswer answer = StoreAnswer::kRefused;
  if (status == NATS_NOT_FOUND) {
    ears_.gone(request.target);
  } else if (status == NATS_OK && kvEntry_Revision(entry) == request.revision) {
    answer = StoreAnswer::kNone;  // it is as it was, so the refusal had another reason
  } else if (status == NATS_OK) {
    const char* value = kvEntry_ValueString(entry);
    // A record that cannot be read is nobody's, and may be replaced.
    const auto record = parse_record(value == nullptr ? "" : value);
    ears_.learn(request.target, record.value_or(OwnerRecord{}), kvEntry_Revision(entry));
  }
  kvEntry_Destroy(entry);
  return answer;
}

void OwnerStore::watch() {
  kvWatcher* watcher = nullptr;
  double heard_s = clock_monotonic_s();
  while (!ends_) {
    if (watcher == nullptr && kvStore_WatchAll(&watcher, store_, nullptr) != NATS_OK) {
      watcher = nullptr;
      std::this_thread::sleep_for(kProbe);
      continue;
    }
    kvEntry* entry = nullptr;
    const natsStatus status = kvWatcher_Next(&entry, watcher, kWatch_ms);
    if (status == NATS_OK && entry != nullptr && kvEntry_Operation(entry) == kvOp_Put) {
      const char* value = kvEntry_ValueString(entry);
      tell(kvEntry_Key(entry), value == nullptr ? "" : value, kvEntry_Revision(entry));
    }
    kvEntry_Destroy(entry);
    const double now_s = clock_monotonic_s();
    if (status == NATS_OK) heard_s = now_s;
    if (status == NATS_OK || (status == NATS_TIMEOUT && now_s - heard_s < kDeaf_s)) continue;
    heard_s = now_s;
    kvWatcher_Destroy(std::exchange(watcher, nullptr));
  }
  kvWatcher_Destroy(watcher);
}

void OwnerStore::tell(const std::string& key, const std::string& value,
                      std::uint64_t revision) const {
  if (key.starts_with(kWish)) {
    ears_.wish(key.substr(kWish.size()), value, revision);
    return;
  }
  if (!key.starts_with(kTarget)) return;
  if (const auto record = parse_record(value)) {
    ears_.learn(key.substr(kTarget.size()), *record, revision);
  }
}

}  // namespace ols::bridge
