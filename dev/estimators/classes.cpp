#include <array>
#include <cstdio>
#include <random>
#include <stdexcept>
#include <string>
#include <tuple>

#include "dev/estimators/class_tracks.h"
#include "dev/estimators/measures.h"

namespace ols::bench {
namespace {

using fusion::ObjectClass;
constexpr int kKinds = static_cast<int>(kSimulatedKinds.size());

// An outline is off by a tenth of a pixel before a clear sky, and by more where the contrast is
// lower; a track's by a tenth of its size.
LookNoise noise_at(double pixels, double ground_m, std::mt19937_64& random) {
  const double px = std::uniform_real_distribution<double>(0.1, 0.5)(random);
  const double speed = std::exp(std::uniform_real_distribution<double>(-2.0, 0.5)(random));
  return {.size = px / pixels, .size_bias = 0.1, .speed_m_s = speed, .ground_m = ground_m};
}

// An elevation model, and flat land taken for granted at 300 m.
constexpr double kKnownGround_m = 3.0, kUnknownGround_m = 60.0;

}  // namespace

void classes(int runs, Limits& limits) {
  constexpr std::uint64_t kSeed = 4003;  // another than that of the table's tracks
  constexpr double kDuration_s = 10.0;
  std::printf("\nclasses: %d tracks of each kind, %.0f s, seed %llu; share of each answer\n", runs,
              kDuration_s, static_cast<unsigned long long>(kSeed));
  for (const auto& [least_px, most_px, ground_m, least_right] :
       {std::tuple{10.0, 20.0, kKnownGround_m, 0.8},
        {20.0, 60.0, kKnownGround_m, 0.95},
        {10.0, 20.0, kUnknownGround_m, 0.8},
        {20.0, 60.0, kUnknownGround_m, 0.85}}) {
    std::printf("%.0f to %.0f px, ground known to %.0f m\n%12s %8s %8s %8s %8s %8s\n", least_px,
                most_px, ground_m, "", "unknown", "drone", "bird", "aircraft", "other");
    std::mt19937_64 random(kSeed);
    double right = 0.0, wrong = 0.0;
    for (int kind = 0; kind < kKinds; ++kind) {
      std::array<double, fusion::kObjectClasses> said{};
      for (int run = 0; run < runs; ++run) {
        const double pixels = std::uniform_real_distribution<double>(least_px, most_px)(random);
        fusion::ClassPosterior posterior;
        for (const auto& seen :
             simulate_looks(kind, kDuration_s, noise_at(pixels, ground_m, random), random))
          posterior.add(seen.utime_us, seen.look);
        said[static_cast<int>(posterior.belief().object_class)] += 1.0 / runs;
      }
      const double own = said[static_cast<int>(kSimulatedKinds[kind].object_class)];
      right += own / kKinds;
      wrong += (1.0 - own - said[0]) / kKinds;
      std::printf("%12s %8.3f %8.3f %8.3f %8.3f %8.3f\n", kSimulatedKinds[kind].name, said[0],
                  said[1], said[2], said[3], said[4]);
    }
    const std::string what = std::to_string(static_cast<int>(least_px)) + " px and more, ground " +
                             std::to_string(static_cast<int>(ground_m)) + " m";
    limits.at_least("right, " + what, right, least_right);
    limits.at_most("wrong, " + what, wrong, 0.05);
  }
}

void write_class_looks(const std::string& file, int runs) {
  constexpr std::uint64_t kSeed = 1;
  std::mt19937_64 random(kSeed);
  std::FILE* const out = std::fopen(file.c_str(), "w");
  if (out == nullptr) throw std::runtime_error(file + ": cannot be written");
  std::fputs("kind,class,size,speed,climb,across,flicker,height\n", out);
  for (int kind = 0; kind < kKinds; ++kind) {
    for (int run = 0; run < runs; ++run) {
      for (const auto& seen : simulate_looks(kind, 5.0, {}, random)) {
        std::fprintf(out, "%s,%d", kSimulatedKinds[kind].name,
                     static_cast<int>(kSimulatedKinds[kind].object_class));
        for (const auto& feature : fusion::features_of(seen.look))
          std::fprintf(out, ",%.6g", feature.value);
        std::fputc('\n', out);
      }
    }
  }
  std::fclose(out);
}

}  // namespace ols::bench
