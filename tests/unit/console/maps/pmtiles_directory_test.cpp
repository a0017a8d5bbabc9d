#include "console/maps/pmtiles_directory.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/console/maps/pmtiles_file.h"

namespace ols::console {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(PmtilesDirectory, TilesAreNumberedAlongAHilbertCurve) {
  // The examples of the specification, and of its reference implementation's tests.
  EXPECT_EQ(tile_number({0, 0, 0}), 0U);
  EXPECT_EQ(tile_number({1, 0, 0}), 1U);
  EXPECT_EQ(tile_number({1, 0, 1}), 2U);
  EXPECT_EQ(tile_number({1, 1, 1}), 3U);
  EXPECT_EQ(tile_number({1, 1, 0}), 4U);
  EXPECT_EQ(tile_number({2, 0, 0}), 5U);
  EXPECT_EQ(tile_number({12, 3423, 1763}), 19078479U);
}

TEST(PmtilesDirectory, TheHeaderSaysWhereEverythingIs) {
  const std::string archive = pmtiles_archive("root", "leaf", "tiles");
  const PmtilesHeader header = parse_pmtiles_header(bytes_of(archive));
  EXPECT_EQ(header.root_offset, 127U);
  EXPECT_EQ(header.leaves_offset, 131U);
  EXPECT_EQ(header.tiles_offset, 135U);
  EXPECT_EQ(header.info.max_zoom, 5);
  EXPECT_DOUBLE_EQ(header.info.bounds_deg[1], 49.0);
  EXPECT_FALSE(header.is_gzipped);
}

TEST(PmtilesDirectory, OtherFilesAreRefused) {
  EXPECT_THROW(parse_pmtiles_header(bytes_of("PMTiles")), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_header(bytes_of(std::string(200, 'x'))), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_header(bytes_of(pmtiles_archive("", "", "", 3))), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_header(bytes_of(pmtiles_archive("", "", "", 1, 1))),
               std::runtime_error);
}

TEST(PmtilesDirectory, FindsATileInItsRun) {
  const std::string text = pmtiles_directory({{5, 2, 10, 0}, {9, 1, 20, 10}, {40, 0, 30, 7}});
  const auto directory = parse_pmtiles_directory(bytes_of(text));
  EXPECT_FALSE(find_tile(directory, 4));
  EXPECT_EQ(find_tile(directory, 6)->bytes, 10U);
  EXPECT_FALSE(find_tile(directory, 7));
  EXPECT_EQ(find_tile(directory, 9)->offset, 10U);
  EXPECT_EQ(find_tile(directory, 1000)->run, 0U) << "a leaf directory knows";
}

TEST(PmtilesDirectory, AnOffsetOfZeroFollowsTheEntryBefore) {
  const std::string text = varint(2) + varint(1) + varint(1) + varint(1) + varint(1) + varint(10) +
                           varint(20) + varint(4) + varint(0);
  const auto directory = parse_pmtiles_directory(bytes_of(text));
  EXPECT_EQ(directory.at(0).offset, 3U);
  EXPECT_EQ(directory.at(1).offset, 13U);
}

TEST(PmtilesDirectory, DamageIsRefused) {
  EXPECT_THROW(parse_pmtiles_directory(bytes_of("")), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_directory(bytes_of(varint(1'000'000'000))), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_directory(bytes_of(varint(1) + varint(1))), std::runtime_error);
  EXPECT_THROW(parse_pmtiles_directory(bytes_of(std::string(20, '\xff'))), std::runtime_error);
}

}  // namespace
}  // namespace ols::console
