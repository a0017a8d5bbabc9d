// The classes of objects and their names, for all programs. Pure.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ols::wire {

// The values are those of target_t's CLASS_*.
enum class ObjectClass { kUnknown, kDrone, kBird, kAircraft, kOther };

struct ObjectClassRow {
  const char* name;  // in configurations, files and messages
  ObjectClass object_class;
};
// In the order of the values of ObjectClass.
inline constexpr std::array kObjectClasses{
    ObjectClassRow{"unknown", ObjectClass::kUnknown}, ObjectClassRow{"drone", ObjectClass::kDrone},
    ObjectClassRow{"bird", ObjectClass::kBird}, ObjectClassRow{"aircraft", ObjectClass::kAircraft},
    ObjectClassRow{"other", ObjectClass::kOther}};

// kUnknown if the number is not one of CLASS_*.
constexpr ObjectClass object_class_of(std::int8_t number) {
  const auto i = static_cast<std::size_t>(number);
  return i < kObjectClasses.size() ? kObjectClasses[i].object_class : ObjectClass::kUnknown;
}

constexpr const char* to_string(ObjectClass object_class) {
  return kObjectClasses[static_cast<std::size_t>(object_class)].name;
}

}  // namespace ols::wire
