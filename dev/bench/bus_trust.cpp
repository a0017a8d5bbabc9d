// What signatures cost: ols-bench-bus-trust. Messages of a bearing's and of a preview's size.
#include <benchmark/benchmark.h>

#include <cstdint>
#include <string>
#include <vector>

#include "base/trust/verifier.h"

namespace {

namespace trust = ols::trust;

constexpr std::int64_t kNow_us = 1'700'000'000'000'000;
constexpr const char* kChannel = "OLS_BEARING_alfa";
constexpr std::int64_t kBearing = 300, kPreview = 60'000;  // [byte]

const trust::SigningKey& member() {
  static const trust::SigningKey key(trust::Seed{1});
  return key;
}

trust::Verifier verifier() {
  trust::TrustList list;
  list.number = 1;
  list.members = {{"alfa", trust::Role::kStation, member().public_key()}};
  return {{}, trust::SiteKey{}, list};
}

// A bearing's head (base/trust/message_head.h), filled up to this size.
std::vector<std::uint8_t> payload(std::int64_t sequence, std::size_t size) {
  std::vector<std::uint8_t> bytes;
  const auto put = [&bytes](std::int64_t value, int width) {
    for (int byte = width - 1; byte >= 0; --byte) {
      bytes.push_back(static_cast<std::uint8_t>(value >> (8 * byte)));
    }
  };
  put(1, 8);
  put(kNow_us, 8);
  put(1, 4);
  put(5, 4);
  for (const char c : {'a', 'l', 'f', 'a', '\0'}) bytes.push_back(static_cast<std::uint8_t>(c));
  put(7, 8);
  put(sequence, 8);
  bytes.resize(size, 0x55);
  return bytes;
}

void sign(benchmark::State& state) {
  const auto content = payload(1, static_cast<std::size_t>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(trust::with_trailer(member(), {}, kChannel, content, 0));
  }
}
BENCHMARK(sign)->Arg(kBearing)->Arg(kPreview);

// Each message is new, and its member within its rate.
void sign_and_verify(benchmark::State& state) {
  auto judge = verifier();
  std::int64_t sequence = 0;
  double now_s = 0.0;
  for (auto _ : state) {
    const auto content = payload(++sequence, static_cast<std::size_t>(state.range(0)));
    const auto message = trust::with_trailer(member(), {}, kChannel, content, 0);
    const auto verdict = judge.judge(kChannel, message, {kNow_us, now_s += 1.0});
    if (verdict.distrust) state.SkipWithError(trust::to_string(*verdict.distrust));
  }
}
BENCHMARK(sign_and_verify)->Arg(kBearing)->Arg(kPreview);

void refuse(benchmark::State& state, const std::vector<std::uint8_t>& message,
            trust::Distrust reason) {
  auto judge = verifier();
  for (auto _ : state) {
    const auto verdict = judge.judge(kChannel, message, {kNow_us, 1.0});
    if (verdict.distrust != reason) state.SkipWithError("another reason");
  }
}

void refuse_unsigned(benchmark::State& state) {
  refuse(state, payload(1, static_cast<std::size_t>(state.range(0))), trust::Distrust::kUnsigned);
}
BENCHMARK(refuse_unsigned)->Arg(kBearing)->Arg(kPreview);

// By a member's key id, which everybody hears, and the wrong secret.
void refuse_stranger(benchmark::State& state) {
  const auto content = payload(1, static_cast<std::size_t>(state.range(0)));
  refuse(state, trust::with_trailer(member(), trust::SiteKey{9}, kChannel, content, 0),
         trust::Distrust::kStranger);
}
BENCHMARK(refuse_stranger)->Arg(kBearing)->Arg(kPreview);

void refuse_replayed(benchmark::State& state) {
  auto judge = verifier();
  const auto message = trust::with_trailer(member(), {}, kChannel,
                                           payload(1, static_cast<std::size_t>(state.range(0))), 0);
  static_cast<void>(judge.judge(kChannel, message, {kNow_us, 1.0}));
  for (auto _ : state) {
    const auto verdict = judge.judge(kChannel, message, {kNow_us, 1.0});
    if (verdict.distrust != trust::Distrust::kReplayed) state.SkipWithError("another reason");
  }
}
BENCHMARK(refuse_replayed)->Arg(kBearing)->Arg(kPreview);

}  // namespace

BENCHMARK_MAIN();
