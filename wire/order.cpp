#include "wire/order.h"

#include <array>
#include <utility>

namespace ols::wire {
namespace {

constexpr std::array<std::pair<Kind, std::string_view>, 12> kNames{{
    {Kind::kDesignate, "designate"},
    {Kind::kPoint, "point"},
    {Kind::kStop, "stop"},
    {Kind::kRelease, "release"},
    {Kind::kRearm, "rearm"},
    {Kind::kHome, "home"},
    {Kind::kReferenceOk, "reference_ok"},
    {Kind::kRecord, "record"},
    {Kind::kRate, "rate"},
    {Kind::kLens, "lens"},
    {Kind::kCentre, "centre"},
    {Kind::kLook, "look"},
}};

}  // namespace

bool is_joystick(const Order& order) {
  return order.kind == Kind::kRate || (order.kind == Kind::kLens && order.lens_rates);
}

double lease_s(const Order& order) { return is_joystick(order) ? kJoystickLease_s : kLease_s; }

std::string_view name(Kind kind) {
  for (const auto& [one, text] : kNames) {
    if (one == kind) return text;
  }
  return "";
}

std::optional<Kind> kind_named(std::string_view name) {
  for (const auto& [kind, text] : kNames) {
    if (text == name) return kind;
  }
  return std::nullopt;
}

}  // namespace ols::wire
