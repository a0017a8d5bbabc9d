// The texts in the folder of a site's land: what it says of itself, buildings and woods.
#include <cmath>
#include <stdexcept>

#include "land/coverings.h"
#include "land/manifest.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace ols::land;

void read_manifest(std::string_view text) {
  const Manifest manifest = parse_manifest(text);
  const std::string written = to_text(manifest);
  ols::fuzz::require(to_text(parse_manifest(written)) == written, "what is written is read");
}

void read_coverings(std::string_view text) {
  const std::vector<Covering> coverings = parse_coverings(text);
  const CoveringIndex index(coverings);
  for (const Covering& covering : coverings) {
    for (const auto& ring : covering.rings) {
      for (const Eigen::Vector2d& corner : ring) {
        index.for_each_at(corner, [&](std::uint32_t found) {
          ols::fuzz::require(found < coverings.size(), "one of them");
        });
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = ols::fuzz::text(data, size);
  for (const auto read : {read_manifest, read_coverings}) {
    try {
      read(text);
    } catch (const std::invalid_argument&) {
    }
  }
  return 0;
}
