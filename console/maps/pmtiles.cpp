#include "console/maps/pmtiles.h"

#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <stdexcept>

namespace ols::console {
namespace {

constexpr std::size_t kMostDirectoryBytes = 4'000'000;
constexpr int kMostDepth = 4;  // of directories below each other (specification)

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

std::string gunzipped(const std::string& bytes, std::size_t most) {
  z_stream stream{};
  constexpr int kGzip = 16;
  if (inflateInit2(&stream, MAX_WBITS + kGzip) != Z_OK) throw std::runtime_error("zlib fails");
  std::string out(most, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int code = inflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  inflateEnd(&stream);
  if (code != Z_STREAM_END) throw std::runtime_error("what is compressed in it is damaged");
  return out;
}

Pmtiles::Pmtiles(const std::string& path) : file_(std::fopen(path.c_str(), "rbe")) {
  if (!file_) throw std::runtime_error(std::strerror(errno));
  header_ = parse_pmtiles_header(bytes_of(read(0, kPmtilesHeaderBytes, kPmtilesHeaderBytes)));
  header_.info.name = std::filesystem::path(path).stem().string();
  header_.info = plausible(header_.info);
  root_ = directory(header_.root_offset, header_.root_bytes);
}

std::string Pmtiles::read(std::uint64_t offset, std::uint64_t bytes, std::uint64_t most) const {
  if (bytes > most || offset > (std::uint64_t{1} << 62U)) {
    throw std::runtime_error("a part of it is too large");
  }
  std::string text(bytes, '\0');
  const bool is_there = ::fseeko(file_.get(), static_cast<off_t>(offset), SEEK_SET) == 0 &&
                        std::fread(text.data(), 1, bytes, file_.get()) == bytes;
  if (!is_there) throw std::runtime_error("is cut off, or no PMTiles archive");
  return text;
}

std::vector<PmtilesEntry> Pmtiles::directory(std::uint64_t offset, std::uint64_t bytes) const {
  std::string text = read(offset, bytes, kMostDirectoryBytes);
  if (header_.is_gzipped) text = gunzipped(text, kMostDirectoryBytes);
  return parse_pmtiles_directory(bytes_of(text));
}

std::optional<std::string> Pmtiles::tile(const TileAddress& address) {
  const std::uint64_t number = tile_number(address);
  auto entry = find_tile(root_, number);
  for (int depth = 1; entry && entry->run == 0; ++depth) {
    if (depth == kMostDepth) throw std::runtime_error("its directories lead nowhere");
    const std::uint64_t offset = header_.leaves_offset + entry->offset;
    if (offset != leaf_offset_) {
      leaf_offset_ = 0;
      leaf_ = directory(offset, entry->bytes);
      leaf_offset_ = offset;
    }
    entry = find_tile(leaf_, number);
  }
  if (!entry) return std::nullopt;
  return read(header_.tiles_offset + entry->offset, entry->bytes, kMostTileBytes);
}

}  // namespace ols::console
