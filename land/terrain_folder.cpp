#include "land/terrain_folder.h"

#include <sodium.h>

#include <array>
#include <bit>
#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "base/config/toml_config.h"
#include "geometry/angles.h"

namespace ols::land {
namespace {

namespace fs = std::filesystem;
namespace mapping = boost::interprocess;

constexpr const char* kManifest = "land.json";
constexpr const char* kCoverings = "coverings.json";
static_assert(std::endian::native == std::endian::little, "grids are mapped as they are");

std::string sha256(const void* bytes, std::size_t size) {
  std::array<unsigned char, crypto_hash_sha256_BYTES> sum{};
  crypto_hash_sha256(sum.data(), static_cast<const unsigned char*>(bytes), size);
  std::string hex(2 * sum.size() + 1, '\0');
  sodium_bin2hex(hex.data(), hex.size(), sum.data(), sum.size());
  hex.pop_back();
  return hex;
}

class MappedFile {
 public:
  explicit MappedFile(const std::string& path) : size_(fs::file_size(path)) {
    if (size_ == 0) return;  // nothing can be mapped
    try {
      region_ = mapping::mapped_region(mapping::file_mapping(path.c_str(), mapping::read_only),
                                       mapping::read_only);
    } catch (const mapping::interprocess_exception& error) {
      throw std::runtime_error(path + ": " + error.what());
    }
  }

  const void* bytes() const { return region_.get_address(); }
  std::string_view text() const { return {static_cast<const char*>(bytes()), size_}; }
  std::string sum() const { return sha256(bytes(), size_); }
  std::size_t size() const { return size_; }

 private:
  std::size_t size_;
  mapping::mapped_region region_;
};

using Mapped = std::vector<std::unique_ptr<const MappedFile>>;

std::size_t heights_of(const GridFile& form) {
  return static_cast<std::size_t>(form.rows) * static_cast<std::size_t>(form.columns);
}

void check_length(const std::string& path, const GridFile& form, std::size_t bytes) {
  const std::size_t wanted = heights_of(form) * sizeof(float);
  if (bytes == wanted) return;
  throw std::runtime_error(path + ": has " + std::to_string(bytes) + " bytes, not " +
                           std::to_string(wanted));
}

HeightGrid map_grid(const std::string& folder, const GridFile& form, Mapped& mapped) {
  const std::string path = folder + "/" + form.file;
  const auto& file = *mapped.emplace_back(std::make_unique<MappedFile>(path));
  check_length(path, form, file.size());
  if (file.sum() != form.sha256) {
    throw std::runtime_error(path + ": is damaged: its SHA-256 is not that of " + kManifest);
  }
  return height_grid(form, {static_cast<const float*>(file.bytes()), heights_of(form)});
}

template <class Parse>
auto parse_file(const std::string& path, const MappedFile& file, Parse parse) {
  try {
    return parse(file.text());
  } catch (const std::invalid_argument& wrong) {
    throw std::runtime_error(path + ": " + wrong.what());
  }
}

// What is wrong with a configured folder, with the key that names it.
template <class Read>
auto named(Read read) {
  try {
    return read();
  } catch (const std::exception& wrong) {
    throw ConfigError("[land] folder: " + std::string(wrong.what()));
  }
}

void write_file(const std::string& path, const void* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  file.close();
  if (!file) throw std::runtime_error(path + ": cannot be written");
}

}  // namespace

HeightGrid height_grid(const GridFile& form, std::span<const float> heights_m) {
  return {radians(form.north_deg),
          radians(form.west_deg),
          radians(form.step_latitude_deg),
          radians(form.step_longitude_deg),
          form.rows,
          form.columns,
          form.sd_m,
          heights_m};
}

TerrainFolder read_terrain_folder(const std::string& path, Scenery scenery,
                                  const std::stop_token& stop) {
  TerrainFolder folder;
  const std::string manifest_path = path + "/" + kManifest,
                    coverings_path = path + "/" + kCoverings;
  const MappedFile manifest(manifest_path), coverings(coverings_path);
  folder.manifest = parse_file(manifest_path, manifest, parse_manifest);
  folder.version = manifest.sum().substr(0, 12);
  if (coverings.sum() != folder.manifest.coverings_sha256) {
    throw std::runtime_error(coverings_path + ": is damaged: its SHA-256 is not that of " +
                             kManifest);
  }
  auto mapped = std::make_shared<Mapped>();
  std::vector<HeightGrid> grids;
  for (const GridFile& form : folder.manifest.grids) {
    if (stop.stop_requested()) throw std::runtime_error(path + ": reading was stopped");
    grids.push_back(map_grid(path, form, *mapped));
  }
  auto covered = parse_file(coverings_path, coverings, parse_coverings);
  if (scenery == Scenery::kLeftOut) {
    std::erase_if(covered, [](const Covering& one) { return one.kind == CoveringKind::kScenery; });
  }
  folder.terrain = std::make_shared<const Terrain>(grids, std::move(covered), mapped);
  return folder;
}

TerrainFolder read_configured_land(const std::string& folder) {
  if (folder.empty()) return {};
  return named([&] { return read_terrain_folder(folder); });
}

Manifest check_configured_land(const std::string& folder) {
  return named([&] {
    const std::string path = folder + "/" + kManifest;
    const Manifest manifest = parse_file(path, MappedFile(path), parse_manifest);
    for (const GridFile& form : manifest.grids) {
      check_length(folder + "/" + form.file, form, fs::file_size(folder + "/" + form.file));
    }
    return manifest;
  });
}

void write_terrain_folder(const std::string& path, Manifest manifest,
                          const std::vector<NewGrid>& grids,
                          const std::vector<Covering>& coverings) {
  if (fs::exists(path)) throw std::runtime_error(path + ": exists");
  const std::string unfinished = path + ".unfinished";
  if (fs::exists(unfinished)) throw std::runtime_error(unfinished + ": exists: remove it first");
  fs::create_directories(unfinished);
  manifest.grids.clear();
  for (const NewGrid& grid : grids) {
    GridFile& form = manifest.grids.emplace_back(grid.form);
    const std::size_t size = grid.heights_m.size() * sizeof(float);
    form.file = "heights-" + std::to_string(manifest.grids.size()) + ".f32";
    form.sha256 = sha256(grid.heights_m.data(), size);
    write_file(unfinished + "/" + form.file, grid.heights_m.data(), size);
  }
  const std::string covering_text = to_text(coverings);
  manifest.coverings_sha256 = sha256(covering_text.data(), covering_text.size());
  write_file(unfinished + "/" + kCoverings, covering_text.data(), covering_text.size());
  const std::string manifest_text = to_text(manifest);
  write_file(unfinished + "/" + kManifest, manifest_text.data(), manifest_text.size());
  fs::rename(unfinished, path);
}

}  // namespace ols::land
