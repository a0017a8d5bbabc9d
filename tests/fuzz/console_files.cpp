// Files that the console opens: logs to replay, directories of PMTiles archives. (SQLite, zlib and
// PNG pictures are their libraries'.)
#include <stdexcept>
#include <variant>

#include "base/bus/log_record.h"
#include "console/maps/pmtiles_directory.h"
#include "console/replay/recorded_frames.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace ols;
using namespace ols::console;

void read_log(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const auto parsed = parse_log_record(bytes);
    std::size_t used = 0;
    if (const auto* record = std::get_if<LogRecord>(&parsed)) {
      used = record->bytes;
      ols::fuzz::require(!record->channel.empty(), "a record has a channel");
    } else if (const auto* garbage = std::get_if<LogGarbage>(&parsed)) {
      used = garbage->bytes;
    } else {
      ols::fuzz::require(std::get<LogNeedsMore>(parsed).bytes > bytes.size(), "more is more");
      return;
    }
    ols::fuzz::require(used > 0 && used <= bytes.size(), "a part of what there is");
    bytes = bytes.subspan(used);
  }
}

void read_archive(std::span<const std::uint8_t> bytes) {
  try {
    static_cast<void>(parse_pmtiles_header(bytes));
  } catch (const std::runtime_error&) {
  }
  try {
    const auto directory = parse_pmtiles_directory(bytes);
    for (const std::uint64_t tile : {std::uint64_t{0}, std::uint64_t{5}, ~std::uint64_t{0}}) {
      static_cast<void>(find_tile(directory, tile));
    }
  } catch (const std::runtime_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (data[0] % 3 == 0) read_log(bytes);
  if (data[0] % 3 == 1) read_archive(bytes);
  if (data[0] % 3 == 2) {
    static_cast<void>(png_size({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
  }
  return 0;
}
