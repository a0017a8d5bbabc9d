// A small site with keys made for tests, and messages of its members as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/trust/trailer.h"
#include "base/trust/trust_list.h"

namespace ols::trust {

inline Seed seed_of(std::uint8_t number) {
  Seed seed{};
  seed.fill(number);
  return seed;
}

struct Site {
  SigningKey root{seed_of(1)}, alfa{seed_of(2)}, bravo{seed_of(3)}, fusion{seed_of(4)},
      anna{seed_of(5)}, stranger{seed_of(6)};
  SiteKey secret = seed_of(9);

  TrustList list(std::int64_t number = 1) const {
    TrustList list;
    list.site = "airfield";
    list.number = number;
    list.root = root.public_key();
    list.members = {{"alfa", Role::kStation, alfa.public_key()},
                    {"bravo", Role::kStation, bravo.public_key()},
                    {"fusion", Role::kFusion, fusion.public_key()},
                    {"anna", Role::kOperator, anna.public_key()}};
    return list;
  }
};

inline void put(std::vector<std::uint8_t>& bytes, std::int64_t value, int size) {
  for (int byte = size - 1; byte >= 0; --byte) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >>
                                              static_cast<unsigned>(8 * byte)));
  }
}

// The head of a message (message_head.h) and some content. With an empty `station`, the head has
// the form kBootFirst.
inline std::vector<std::uint8_t> payload(std::int64_t utime_us, std::int64_t boot_id,
                                         std::int64_t sequence, std::string_view station = "") {
  std::vector<std::uint8_t> bytes;
  put(bytes, 0x0102030405060708, 8);
  put(bytes, utime_us, 8);
  put(bytes, 1, 4);
  if (!station.empty()) {
    put(bytes, static_cast<std::int64_t>(station.size()) + 1, 4);
    bytes.insert(bytes.end(), station.begin(), station.end());
    bytes.push_back(0);
  }
  put(bytes, boot_id, 8);
  put(bytes, sequence, 8);
  for (std::uint8_t i = 0; i < 40; ++i) bytes.push_back(i);
  return bytes;
}

}  // namespace ols::trust
