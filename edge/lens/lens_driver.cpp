#include "edge/lens/lens_driver.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ols::lens {
namespace {

constexpr int kMostRefusals = 3;  // to stand: one may be of the moment

// The version last: who answers it is a lens.
constexpr std::size_t kSetupSteps = 4;

std::string setup_step(std::size_t step) {
  switch (step) {
    case 0:
      return visca::clear_interface();
    case 1:
      return visca::focus_by_hand();
    case 2:
      return visca::exposure_by_hand();
    default:
      return visca::ask_version();
  }
}

// The zoom decides what a pixel means, so it is asked each time; focus and iris in turn between.
constexpr int kRound = 8;

std::optional<Axis> polled(int poll) {
  if (poll % kRound == 3) return Axis::kFocus;
  if (poll % kRound == 7) return Axis::kIris;
  return Axis::kZoom;
}

}  // namespace

void LensDriver::order(const LensOrder& order) {
  for (const Axis axis : kAxes) {
    const auto& given = order.axes[axis];
    if (!given) continue;
    // A rate that is renewed goes on at its pace.
    const double step_s = orders_[axis] ? orders_[axis]->step_s : 0.0;
    orders_[axis] = Pending{*given};
    orders_[axis]->step_s = step_s;
  }
}

void LensDriver::restart() {
  packets_.clear();
  waiting_.reset();
  orders_ = {};
  setup_ = 0;
  silent_ = 0;
  state_.ready = false;
  state_.positions = {};
}

bool LensDriver::take_link_loss() { return std::exchange(link_lost_, false); }

std::vector<ZoomSample> LensDriver::take_samples() { return std::exchange(samples_, {}); }

LensCounters LensDriver::counters() const {
  LensCounters counters = counters_;
  counters.garbled += packets_.garbled();
  return counters;
}

std::string LensDriver::step(double time_s) {
  if (waiting_ && time_s - waiting_->sent_s > kReply_s) give_up(time_s);
  if (waiting_) return {};
  waiting_ = next(time_s);
  if (!waiting_) return {};
  ++counters_.requests;
  waiting_->sent_s = time_s;
  return waiting_->bytes;
}

// An order that may have been lost is sent again; a rate that has ended by then, as its end.
void LensDriver::give_up(double) {
  ++counters_.timeouts;
  if (waiting_->question == Question::kOrder && orders_[waiting_->axis]) {
    orders_[waiting_->axis]->sent = false;
  }
  waiting_.reset();
  if (++silent_ < kSilent) return;
  silent_ = 0;
  link_lost_ = true;
}

bool LensDriver::is_stand(const std::optional<Pending>& pending) {
  return pending && !pending->order.position && pending->order.rate == 0.0;
}

std::optional<LensDriver::Request> LensDriver::next(double time_s) {
  if (setup_ < kSetupSteps) {
    const bool last = setup_ + 1 == kSetupSteps;
    return Request{last ? Question::kVersion : Question::kSetup, Axis::kZoom, setup_step(setup_)};
  }
  for (const Axis axis : kAxes) {
    if (auto request = next_order(axis, time_s)) return request;
  }
  return next_question(time_s);
}

std::optional<LensDriver::Request> LensDriver::next_order(Axis axis, double time_s) {
  auto& pending = orders_[axis];
  if (!pending) return std::nullopt;
  const AxisOrder& order = pending->order;
  if (order.position) {
    if (std::exchange(pending->sent, true)) return std::nullopt;
    return Request{Question::kOrder, axis, visca::go_to(axis, *order.position)};
  }
  if (order.rate == 0.0 || time_s >= order.until_s) {
    const int refusals = pending->refusals;
    pending.reset();
    const std::string end = visca::stand(axis);
    if (end.empty()) return std::nullopt;
    // Until the lens has said that it stands, this is sent again.
    pending = Pending{AxisOrder{std::nullopt, 0.0, time_s}};
    pending->refusals = refusals;
    return Request{Question::kOrder, axis, end};
  }
  const bool steps = axis == Axis::kIris;
  if (steps && time_s < pending->step_s) return std::nullopt;
  if (!steps && pending->sent) return std::nullopt;
  pending->sent = true;
  pending->step_s = time_s + kIrisStep_s / std::max(0.1, std::abs(order.rate));
  return Request{Question::kOrder, axis, visca::go_on(axis, order.rate)};
}

std::optional<LensDriver::Request> LensDriver::next_question(double time_s) {
  if (time_s - polled_s_ < poll_interval_s_) return std::nullopt;
  polled_s_ = time_s;
  const Axis axis = *polled(polls_++);
  return Request{Question::kPosition, axis, visca::ask_position(axis)};
}

void LensDriver::receive(std::string_view bytes, double time_s) {
  for (const std::string& packet : packets_.receive(bytes)) {
    if (const auto reply = visca::reply(packet)) {
      take(*reply, time_s);
    } else {
      ++counters_.garbled;
    }
  }
}

void LensDriver::take(const visca::Reply& reply, double time_s) {
  // The completion of a long move may come at any time.
  if (!waiting_) return;
  const bool asks =
      waiting_->question == Question::kVersion || waiting_->question == Question::kPosition;
  const bool answers =
      reply.kind == visca::ReplyKind::kError || (reply.kind == visca::ReplyKind::kValue) == asks;
  if (!answers) return;
  const Request request = *std::exchange(waiting_, std::nullopt);
  silent_ = 0;
  ++counters_.replies;
  if (reply.kind == visca::ReplyKind::kError) {
    ++counters_.refusals;
    state_.last_error = reply.text;
    // A lens without an iris refuses to close it; it is a lens all the same.
    if (setup_ + 1 < kSetupSteps) ++setup_;
    // One that cannot be moved refuses to stand, too; the zoom must be asked for nevertheless.
    auto& refused = orders_[request.axis];
    if (request.question == Question::kOrder && is_stand(refused) &&
        ++refused->refusals >= kMostRefusals) {
      refused.reset();
    }
    return;
  }
  if (asks) return take_value(request, reply.data, time_s);
  if (request.question == Question::kSetup) ++setup_;
  auto& pending = orders_[request.axis];
  if (request.question == Question::kOrder && is_stand(pending)) pending.reset();
}

void LensDriver::take_value(const Request& request, const std::string& data, double time_s) {
  if (request.question == Question::kVersion) {
    const auto version = visca::version_in(data);
    if (!version) {
      ++counters_.garbled;
      return;
    }
    state_.version = *version;
    ++setup_;
    return;
  }
  const auto position = visca::position_in(request.axis, data);
  if (!position) {
    ++counters_.garbled;
    return;
  }
  state_.positions[request.axis] = position;
  state_.last_good_s = time_s;
  if (request.axis != Axis::kZoom) return;
  state_.ready = true;
  const double took_s = time_s - request.sent_s;
  samples_.push_back({request.sent_s + 0.5 * took_s, took_s / std::sqrt(12.0), *position});
}

}  // namespace ols::lens
