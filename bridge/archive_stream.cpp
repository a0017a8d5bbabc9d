#include "bridge/archive_stream.h"

#include <nats/nats.h>

#include <chrono>
#include <memory>
#include <utility>

#include "base/trust/message_head.h"

namespace ols::bridge {
namespace {

constexpr auto kLook = std::chrono::seconds(2);
constexpr std::int64_t kPatience_ms = 2000;

struct Free {
  void operator()(jsCtx* js) const { jsCtx_Destroy(js); }
  void operator()(jsStreamInfo* info) const { jsStreamInfo_Destroy(info); }
  void operator()(natsMsg* message) const { natsMsg_Destroy(message); }
};
template <class T>
using Held = std::unique_ptr<T, Free>;

Held<jsCtx> open(NatsLink& link, const std::string& domain) {
  jsOptions options;
  jsOptions_Init(&options);
  options.Wait = kPatience_ms;
  if (!domain.empty()) options.Domain = domain.c_str();
  jsCtx* js = nullptr;
  natsConnection_JetStream(&js, link.connection(), &options);
  return Held<jsCtx>(js);
}

std::string words(natsStatus status) {
  const char* detail = nats_GetLastError(nullptr);
  return std::string(natsStatus_GetText(status)) +
         (detail == nullptr || *detail == '\0' ? "" : std::string(": ") + detail);
}

bool is_ours(const jsStreamInfo& info, const BridgeConfig& config) {
  std::vector<std::string> subjects, sources;
  for (int i = 0; i < info.Config->SubjectsLen; ++i) {
    subjects.emplace_back(info.Config->Subjects[i]);
  }
  for (int i = 0; i < info.Config->SourcesLen; ++i) {
    sources.emplace_back(info.Config->Sources[i]->Name);
  }
  return is_same_stream(config, subjects, sources);
}

// Makes the stream, or changes the existing one to the plan.
natsStatus make(jsCtx* js, const StreamPlan& plan, const BridgeConfig& config,
                Held<jsStreamInfo>& info) {
  std::vector<const char*> subjects;
  for (const std::string& subject : plan.subjects) subjects.push_back(subject.c_str());
  std::vector<std::string> prefixes;
  for (const StreamSource& source : plan.sources) {
    prefixes.push_back("$JS." + source.domain + ".API");
  }
  std::vector<jsExternalStream> external(plan.sources.size());
  std::vector<jsStreamSource> sources(plan.sources.size());
  std::vector<jsStreamSource*> pointers;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    jsExternalStream_Init(&external[i]);
    external[i].APIPrefix = prefixes[i].c_str();
    external[i].DeliverPrefix = "";  // libnats 3.4.1 would read through a null
    jsStreamSource_Init(&sources[i]);
    sources[i].Name = plan.sources[i].stream.c_str();
    sources[i].External = &external[i];
    pointers.push_back(&sources[i]);
  }
  jsStreamConfig stream;
  jsStreamConfig_Init(&stream);
  stream.Name = plan.name.c_str();
  stream.Subjects = subjects.empty() ? nullptr : subjects.data();
  stream.SubjectsLen = static_cast<int>(subjects.size());
  stream.Sources = pointers.empty() ? nullptr : pointers.data();
  stream.SourcesLen = static_cast<int>(pointers.size());
  stream.MaxAge = plan.keep_ns;
  stream.MaxBytes = plan.most_bytes;
  stream.Storage = js_FileStorage;
  jsStreamInfo* made = nullptr;
  natsStatus status = js_AddStream(&made, js, &stream, nullptr, nullptr);
  if (status == NATS_OK) {
    info.reset(made);
    return status;
  }
  // The stream exists with other settings. If it is somebody else's, it is left alone.
  jsStreamInfo* there = nullptr;
  if (js_GetStreamInfo(&there, js, plan.name.c_str(), nullptr, nullptr) != NATS_OK) return status;
  const Held<jsStreamInfo> known(there);
  if (!is_ours(*there, config)) return NATS_ILLEGAL_STATE;
  status = js_UpdateStream(&made, js, &stream, nullptr, nullptr);
  info.reset(made);
  return status;
}

std::int64_t newest_utime_us(jsCtx* js, const std::string& stream, const std::string& subject) {
  natsMsg* found = nullptr;
  if (js_GetLastMsg(&found, js, stream.c_str(), subject.c_str(), nullptr, nullptr) != NATS_OK) {
    return 0;
  }
  const Held<natsMsg> message(found);
  const auto* data = reinterpret_cast<const std::uint8_t*>(natsMsg_GetData(found));
  const auto head = trust::read_head({data, static_cast<std::size_t>(natsMsg_GetDataLength(found))},
                                     trust::HeadForm::kStationFirst);
  return head ? head->utime_us : 0;
}

}  // namespace

ArchiveStream::ArchiveStream(NatsLink& link, StreamPlan plan, const BridgeConfig& config)
    : link_(link), plan_(std::move(plan)), config_(config), thread_([this] { work(); }) {}

ArchiveStream::~ArchiveStream() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  end_.notify_all();
  thread_.join();
}

ArchiveReport ArchiveStream::report() const {
  const std::lock_guard lock(mutex_);
  return report_;
}

void ArchiveStream::work() {
  std::unique_lock lock(mutex_);
  while (!ends_) {
    lock.unlock();
    ArchiveReport seen = look();
    lock.lock();
    report_ = std::move(seen);
    end_.wait_for(lock, kLook, [this] { return ends_; });
  }
}

ArchiveReport ArchiveStream::look() {
  ArchiveReport seen;
  if (!link_.report().is_open) {
    seen.trouble = "no connection";
    return seen;
  }
  const Held<jsCtx> js = open(link_, config_.archive.domain);
  Held<jsStreamInfo> info;
  jsStreamInfo* got = nullptr;
  natsStatus status = NATS_OK;
  if (is_made_) {
    status = js_GetStreamInfo(&got, js.get(), plan_.name.c_str(), nullptr, nullptr);
    info.reset(got);
  } else {
    status = make(js.get(), plan_, config_, info);
  }
  is_made_ = status == NATS_OK;
  if (!is_made_) {
    seen.trouble =
        status == NATS_ILLEGAL_STATE ? plan_.name + " is not this bridge's stream" : words(status);
    return seen;
  }
  seen.is_kept = true;
  seen.trouble.clear();
  seen.messages = info->State.Msgs;
  seen.bytes = info->State.Bytes;
  for (const StreamSource& source : plan_.sources) {
    const std::string subject = "ols.v1." + config_.region + "." + source.domain + ".*.status";
    seen.sources.push_back({source.domain, newest_utime_us(js.get(), plan_.name, subject)});
  }
  return seen;
}

}  // namespace ols::bridge
