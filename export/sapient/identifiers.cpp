#include "export/sapient/identifiers.h"

#include <boost/uuid/name_generator_sha1.hpp>
#include <boost/uuid/uuid.hpp>
#include <boost/uuid/uuid_io.hpp>
#include <cstddef>
#include <string_view>

namespace ols::exports {
namespace {

// The namespace of all our names, drawn once.
constexpr boost::uuids::uuid kNamespace{{0x6f, 0x1d, 0x0c, 0x5e, 0x93, 0x42, 0x4a, 0x8b, 0xb7, 0x25,
                                         0x0e, 0x61, 0xd4, 0x8f, 0x3a, 0x19}};

boost::uuids::uuid hash_of(const std::string& name) {
  return boost::uuids::name_generator_sha1(kNamespace)(name);
}

bool is_hexadecimal(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

}  // namespace

std::string uuid_of(const std::string& name) {
  boost::uuids::uuid id = hash_of(name);
  id.data[6] = static_cast<std::uint8_t>((id.data[6] & 0x0fU) | 0x40U);
  return to_string(id);
}

bool is_uuid(const std::string& text) {
  constexpr std::string_view kForm = "xxxxxxxx-xxxx-4xxx-Nxxx-xxxxxxxxxxxx";
  if (text.size() != kForm.size()) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool fits = kForm[i] == 'x' ? is_hexadecimal(text[i])
                      : kForm[i] == 'N'
                          ? std::string_view("89ab").find(text[i]) != std::string::npos
                          : text[i] == kForm[i];
    if (!fits) return false;
  }
  return true;
}

// 48 bits of time and 80 others, five at a time from the end.
std::string ulid_of(std::int64_t time_ms, const std::string& name) {
  constexpr std::string_view kDigits = "0123456789ABCDEFGHJKMNPQRSTVWXYZ";
  constexpr int kTimeDigits = 10;
  std::string text(26, '0');
  auto time = static_cast<std::uint64_t>(time_ms) & 0xffff'ffff'ffffU;
  for (int i = kTimeDigits - 1; i >= 0; --i, time >>= 5U) {
    text[static_cast<std::size_t>(i)] = kDigits[time & 31U];
  }
  const boost::uuids::uuid hash = hash_of(name);
  unsigned bits = 0, count = 0;
  std::size_t next = hash.size();
  for (std::size_t i = text.size(); i > kTimeDigits; --i) {
    if (count < 5) {
      bits |= static_cast<unsigned>(hash.data[--next]) << count;
      count += 8;
    }
    text[i - 1] = kDigits[bits & 31U];
    bits >>= 5U;
    count -= 5;
  }
  return text;
}

}  // namespace ols::exports
