// Derives the seeds of independent random streams from one seed. Pure.
#pragma once

#include <cstdint>

namespace ols::sim {

// The seed for one purpose (`tag`) in one run (`seed`). Different tags give independent streams,
// and so do neighbouring seeds (SplitMix64).
inline std::uint64_t derived_seed(std::uint64_t seed, std::uint64_t tag) {
  std::uint64_t z = seed + 0x9e3779b97f4a7c15ULL * (tag + 1);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace ols::sim
