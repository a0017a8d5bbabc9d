#include "edge/lens/lens_handover.h"

#include "base/process/clocks.h"

namespace ols::lens {

void LensHandover::order(const LensOrder& order) {
  const std::lock_guard lock(mutex_);
  driver_.order(order);
}

std::vector<ZoomSample> LensHandover::take_samples() {
  const std::lock_guard lock(mutex_);
  return samples_.take();
}

ByAxis<std::optional<double>> LensHandover::positions() const {
  const std::lock_guard lock(mutex_);
  return driver_.state().positions;
}

device::DeviceReport LensHandover::report() const {
  const std::lock_guard lock(mutex_);
  device::DeviceReport r = line();
  const LensState& state = driver_.state();
  if (r.state == device::DeviceState::kOk) {
    r.text = state.ready ? state.version : "waiting for its positions";
    if (!state.ready) r.state = device::DeviceState::kStarting;
  }
  r.last_good_s = state.last_good_s;
  const LensCounters counters = driver_.counters();
  r.counters["lens_requests"] = counters.requests;
  r.counters["lens_replies"] = counters.replies;
  r.counters["lens_timeouts"] = counters.timeouts;
  r.counters["lens_refusals"] = counters.refusals;
  r.counters["lens_garbled"] = counters.garbled;
  return r;
}

LensHandover::Turn LensHandover::turn(const std::string& arrived) {
  const std::lock_guard lock(mutex_);
  Turn turn;
  const double now_s = clock_monotonic_s();
  driver_.receive(arrived, now_s);
  turn.request = driver_.step(now_s);
  for (const ZoomSample& sample : driver_.take_samples()) {
    samples_.add(sample);
    turn.works = true;
  }
  turn.link_lost = driver_.take_link_loss();
  return turn;
}

void LensHandover::restart() {
  const std::lock_guard lock(mutex_);
  driver_.restart();
}

}  // namespace ols::lens
