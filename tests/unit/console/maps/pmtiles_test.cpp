#include "console/maps/pmtiles.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <stdexcept>

#include "tests/unit/console/maps/pmtiles_file.h"

namespace ols::console {
namespace {

std::string gzipped(const std::string& text) {
  z_stream stream{};
  deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, MAX_WBITS + 16, 8, Z_DEFAULT_STRATEGY);
  std::string out(text.size() + 100, '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
  stream.avail_in = static_cast<uInt>(text.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

TEST(Pmtiles, FindsTilesThroughCompressedLeafDirectories) {
  const std::uint64_t number = tile_number({2, 1, 1});
  const std::string leaf = gzipped(pmtiles_directory({{number, 1, kPng.size(), 3}}));
  const std::string root = gzipped(pmtiles_directory({{5, 0, leaf.size(), 0}}));
  const MapFolder folder;
  folder.write("a.pmtiles", pmtiles_archive(root, leaf, "abc" + kPng, 2));
  Pmtiles map(folder.path("a.pmtiles"));
  EXPECT_EQ(map.info().name, "a");
  EXPECT_EQ(map.info().min_zoom, 2);
  EXPECT_EQ(map.tile({2, 1, 1}), kPng);
  EXPECT_EQ(map.tile({2, 1, 1}), kPng) << "again";
  EXPECT_FALSE(map.tile({2, 3, 3}));
}

TEST(Pmtiles, LeafDirectoriesThatLeadNowhereAreSaid) {
  const std::string leaf = pmtiles_directory({{5, 0, 5, 0}});
  const MapFolder folder;
  folder.write("a.pmtiles",
               pmtiles_archive(pmtiles_directory({{5, 0, leaf.size(), 0}}), leaf, "", 1));
  Pmtiles map(folder.path("a.pmtiles"));
  EXPECT_THROW(map.tile({2, 1, 1}), std::runtime_error);
}

TEST(Pmtiles, AnArchiveThatIsCutOffIsSaid) {
  const std::string root = pmtiles_directory({{5, 1, 1'000'000, 0}});
  const std::string whole = pmtiles_archive(root, "", "short");
  const MapFolder folder;
  folder.write("a.pmtiles", whole);
  Pmtiles map(folder.path("a.pmtiles"));
  EXPECT_THROW(map.tile({2, 0, 0}), std::runtime_error);
  folder.write("b.pmtiles", whole.substr(0, 129));
  EXPECT_THROW(Pmtiles(folder.path("b.pmtiles")), std::runtime_error);
  EXPECT_THROW(Pmtiles(folder.path("none.pmtiles")), std::runtime_error);
}

TEST(Pmtiles, WhatGrowsWithoutEndIsRefused) {
  EXPECT_EQ(gunzipped(gzipped("text"), 4), "text");
  EXPECT_THROW(gunzipped(gzipped(std::string(100'000, 'x')), 1000), std::runtime_error);
  EXPECT_THROW(gunzipped("no gzip", 1000), std::runtime_error);
}

}  // namespace
}  // namespace ols::console
