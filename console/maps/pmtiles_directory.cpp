#include "console/maps/pmtiles_directory.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

namespace ols::console {
namespace {

constexpr std::uint64_t kMostEntries = 1'000'000;

std::uint64_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8U | bytes[i];
  return value;
}

// In ten millionths of a degree.
double degrees_of(std::span<const std::uint8_t> bytes) {
  return static_cast<std::int32_t>(little_endian(bytes)) * 1e-7;
}

class Varints {
 public:
  explicit Varints(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  std::uint64_t next() {
    std::uint64_t value = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      if (at_ >= bytes_.size()) throw std::runtime_error("a directory is cut off");
      const std::uint8_t byte = bytes_[at_++];
      value |= static_cast<std::uint64_t>(byte & 0x7FU) << shift;
      if ((byte & 0x80U) == 0) return value;
    }
    throw std::runtime_error("a directory has an endless number");
  }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

}  // namespace

PmtilesHeader parse_pmtiles_header(std::span<const std::uint8_t> b) {
  const std::string_view magic(reinterpret_cast<const char*>(b.data()),
                               std::min<std::size_t>(b.size(), 7));
  if (b.size() < kPmtilesHeaderBytes || magic != "PMTiles")
    throw std::runtime_error("is no PMTiles archive");
  if (b[7] != 3) throw std::runtime_error("is a PMTiles archive of another version than 3");
  PmtilesHeader header;
  const auto number = [&b](std::size_t at) { return little_endian(b.subspan(at, 8)); };
  header.root_offset = number(8);
  header.root_bytes = number(16);
  header.leaves_offset = number(40);
  header.leaves_bytes = number(48);
  header.tiles_offset = number(56);
  header.tiles_bytes = number(64);
  constexpr std::uint8_t kNotCompressed = 1, kGzip = 2, kVectors = 1;
  if (b[97] != kNotCompressed && b[97] != kGzip) {
    throw std::runtime_error("its directories are compressed by something else than gzip");
  }
  header.is_gzipped = b[97] == kGzip;
  if (b[99] == kVectors) {
    throw std::runtime_error("holds vector tiles; only maps of pictures are shown");
  }
  header.info.min_zoom = b[100];
  header.info.max_zoom = b[101];
  for (std::size_t i = 0; i < 4; ++i)
    header.info.bounds_deg[i] = degrees_of(b.subspan(102 + 4 * i, 4));
  return header;
}

std::vector<PmtilesEntry> parse_pmtiles_directory(std::span<const std::uint8_t> bytes) {
  Varints numbers(bytes);
  const std::uint64_t count = numbers.next();
  // Each entry has four numbers of a byte at least.
  if (count > kMostEntries || count > bytes.size())
    throw std::runtime_error("a directory is too long");
  std::vector<PmtilesEntry> entries(count);
  std::uint64_t tile = 0;
  for (auto& entry : entries) entry.tile = tile += numbers.next();
  for (auto& entry : entries) entry.run = static_cast<std::uint32_t>(numbers.next());
  for (auto& entry : entries) entry.bytes = static_cast<std::uint32_t>(numbers.next());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::uint64_t offset = numbers.next();
    const bool follows = offset == 0 && i > 0;  // directly behind the one before
    entries[i].offset = follows ? entries[i - 1].offset + entries[i - 1].bytes : offset - 1;
  }
  return entries;
}

std::optional<PmtilesEntry> find_tile(const std::vector<PmtilesEntry>& directory,
                                      std::uint64_t tile) {
  const auto after = std::ranges::upper_bound(directory, tile, {}, &PmtilesEntry::tile);
  if (after == directory.begin()) return std::nullopt;
  const PmtilesEntry& entry = *(after - 1);
  const bool is_leaf = entry.run == 0;
  if (is_leaf || tile - entry.tile < entry.run) return entry;
  return std::nullopt;
}

std::uint64_t tile_number(const TileAddress& address) {
  std::uint64_t before = 0;  // tiles of the lower zoom levels
  for (int zoom = 0; zoom < address.zoom; ++zoom) before += std::uint64_t{1} << (2 * zoom);
  auto x = static_cast<std::uint64_t>(address.column), y = static_cast<std::uint64_t>(address.row);
  std::uint64_t along = 0;
  // Wikipedia, "Hilbert curve": xy2d.
  for (std::uint64_t side = address.zoom == 0 ? 0 : std::uint64_t{1} << (address.zoom - 1);
       side > 0; side /= 2) {
    const std::uint64_t right = (x & side) != 0 ? 1 : 0, lower = (y & side) != 0 ? 1 : 0;
    along += side * side * ((3 * right) ^ lower);
    x &= side - 1;
    y &= side - 1;
    if (lower == 1) continue;
    if (right == 1) {
      x = side - 1 - x;
      y = side - 1 - y;
    }
    std::swap(x, y);
  }
  return before + along;
}

}  // namespace ols::console
