#include "tools/land/mosaic.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "geometry/angles.h"

namespace ols::land {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr std::size_t kFewestPairs = 10;  // to judge a seam by

// Differences of two files, second minus first.
struct Difference {
  std::size_t count = 0;
  double sum_m = 0.0, greatest_m = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;  // of the greatest

  void add(double difference_m, double latitude, double longitude) {
    ++count;
    sum_m += difference_m;
    if (count > 1 && std::abs(difference_m) <= std::abs(greatest_m)) return;
    greatest_m = difference_m;
    latitude_deg = latitude;
    longitude_deg = longitude;
  }
  double mean_m() const { return sum_m / static_cast<double>(count); }
};

class Judge {
 public:
  Judge(double sd_m, bool accept_seams) : limit_m_(3.0 * sd_m), accept_(accept_seams) {}

  void judge(const std::string& first, const std::string& second, const Difference& difference,
             const std::string& how) {
    if (difference.count < kFewestPairs) return;
    std::ostringstream text;
    text.precision(7);
    text << first << " and " << second << ' ' << how << ' ' << difference.count << " places";
    if (difference.greatest_m == 0.0) {
      text << ", with equal heights";
    } else {
      text << ", " << difference.mean_m() << " m apart on average, at most "
           << difference.greatest_m << " m at " << difference.latitude_deg << ", "
           << difference.longitude_deg;
    }
    if (std::abs(difference.mean_m()) > limit_m_ && !accept_) {
      throw std::runtime_error(text.str() +
                               ": they do not join: one has another vertical datum or place, or is "
                               "damaged (--accept-seams takes them as they are)");
    }
    notes.push_back(text.str());
  }

  std::vector<std::string> notes;

 private:
  double limit_m_;
  bool accept_;
};

bool is_same_lattice(const Raster& a, const Raster& b) {
  const auto same_step = [](double x, double y) { return std::abs(x - y) < 1e-6 * x; };
  const auto in_phase = [](double offset, double step) {
    return std::abs(std::remainder(offset, step)) < 0.01 * step;
  };
  return same_step(a.step_latitude_deg, b.step_latitude_deg) &&
         same_step(a.step_longitude_deg, b.step_longitude_deg) &&
         in_phase(a.north_deg - b.north_deg, a.step_latitude_deg) &&
         in_phase(a.west_deg - b.west_deg, a.step_longitude_deg);
}

// One lattice, with the file that each height is of.
class Sheet {
 public:
  explicit Sheet(const std::vector<const Raster*>& rasters) : rasters_(rasters) {
    const Raster& first = *rasters[0];
    grid_.step_latitude_deg = first.step_latitude_deg;
    grid_.step_longitude_deg = first.step_longitude_deg;
    double north = -1e9, south = 1e9, west = 1e9, east = -1e9;
    for (const Raster* one : rasters) {
      north = std::max(north, one->north_deg);
      south = std::min(south, one->latitude_deg(one->rows - 1));
      west = std::min(west, one->west_deg);
      east = std::max(east, one->longitude_deg(one->columns - 1));
    }
    grid_.north_deg = north;
    grid_.west_deg = west;
    grid_.rows = 1 + static_cast<int>(std::lround((north - south) / grid_.step_latitude_deg));
    grid_.columns = 1 + static_cast<int>(std::lround((east - west) / grid_.step_longitude_deg));
    const std::size_t size =
        static_cast<std::size_t>(grid_.rows) * static_cast<std::size_t>(grid_.columns);
    if (static_cast<double>(size) > kMostHeights) {
      throw std::runtime_error(first.name +
                               " and its neighbours have too many heights within the " +
                               "radius: take a smaller one, or a coarser model");
    }
    heights_m_.assign(size, kUnknown);
    owners_.assign(size, 0);
    for (std::size_t i = 0; i < rasters.size(); ++i) paste(i);
  }

  void judge(Judge& judge) {
    step_across(0, 1);
    step_across(1, 0);
    for (const auto& [pair, difference] : shared_) tell(judge, pair, difference, "share");
    for (const auto& [pair, difference] : across_) {
      if (!shared_.contains(pair)) tell(judge, pair, difference, "meet at");
    }
  }

  NewGrid take(double sd_m) {
    grid_.sd_m = sd_m;
    return {grid_, std::move(heights_m_)};
  }

 private:
  using Pair = std::pair<std::uint16_t, std::uint16_t>;

  std::size_t index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.columns) +
           static_cast<std::size_t>(column);
  }
  void add(std::map<Pair, Difference>& to, const Pair& pair, double difference_m, int row,
           int column) {
    to[pair].add(difference_m, grid_.north_deg - row * grid_.step_latitude_deg,
                 grid_.west_deg + column * grid_.step_longitude_deg);
  }
  void tell(Judge& judge, const Pair& pair, const Difference& difference, const std::string& how) {
    judge.judge(rasters_[pair.first]->name, rasters_[pair.second]->name, difference, how);
  }

  void paste(std::size_t number) {
    const Raster& raster = *rasters_[number];
    const auto owner = static_cast<std::uint16_t>(number);
    const int top = static_cast<int>(
        std::lround((grid_.north_deg - raster.north_deg) / grid_.step_latitude_deg));
    const int left = static_cast<int>(
        std::lround((raster.west_deg - grid_.west_deg) / grid_.step_longitude_deg));
    const float* height = raster.heights_m.data();
    for (int row = top; row < top + raster.rows; ++row) {
      for (int column = left; column < left + raster.columns; ++column, ++height) {
        if (std::isnan(*height)) continue;
        float& there = heights_m_[index(row, column)];
        std::uint16_t& owned = owners_[index(row, column)];
        if (std::isnan(there)) {
          there = *height;
          owned = owner;
        } else {
          add(shared_, {owned, owner}, double{*height} - double{there}, row, column);
        }
      }
    }
  }

  // Where files touch without sharing heights: the step from one to the other, beyond what the
  // slopes on both sides explain.
  void step_across(int down, int right) {
    for (int row = down; row + 2 * down < grid_.rows; ++row) {
      for (int column = right; column + 2 * right < grid_.columns; ++column) {
        const std::size_t a = index(row, column), b = index(row + down, column + right);
        if (owners_[a] == owners_[b]) continue;
        const double before = heights_m_[index(row - down, column - right)];
        const double after = heights_m_[index(row + 2 * down, column + 2 * right)];
        const double slope_m = 0.5 * ((heights_m_[a] - before) + (after - heights_m_[b]));
        const double step_m = double{heights_m_[b]} - double{heights_m_[a]} - slope_m;
        if (std::isnan(step_m)) continue;
        const bool ordered = owners_[a] < owners_[b];
        add(across_, ordered ? Pair{owners_[a], owners_[b]} : Pair{owners_[b], owners_[a]},
            ordered ? step_m : -step_m, row, column);
      }
    }
  }

  const std::vector<const Raster*>& rasters_;
  GridFile grid_;
  std::vector<float> heights_m_;
  std::vector<std::uint16_t> owners_;
  std::map<Pair, Difference> shared_, across_;
};

// Two grids at places of the finer one.
Difference compare(const NewGrid& fine, const NewGrid& coarse) {
  const Terrain other({height_grid(coarse.form, coarse.heights_m)}, {}, nullptr);
  const Terrain own({height_grid(fine.form, fine.heights_m)}, {}, nullptr);
  constexpr int kPlaces = 100;  // in each direction
  Difference difference;
  for (int i = 0; i < kPlaces; ++i) {
    for (int k = 0; k < kPlaces; ++k) {
      const double latitude_deg = fine.form.north_deg - (i + 0.5) / kPlaces * (fine.form.rows - 1) *
                                                            fine.form.step_latitude_deg;
      const double longitude_deg = fine.form.west_deg + (k + 0.5) / kPlaces *
                                                            (fine.form.columns - 1) *
                                                            fine.form.step_longitude_deg;
      const auto a = own.ground(radians(latitude_deg), radians(longitude_deg));
      const auto b = other.ground(radians(latitude_deg), radians(longitude_deg));
      if (a && b) difference.add(b->height_m - a->height_m, latitude_deg, longitude_deg);
    }
  }
  return difference;
}

}  // namespace

Mosaic join(const std::vector<Raster>& rasters, double sd_m, bool accept_seams) {
  std::vector<std::vector<const Raster*>> lattices;
  for (const Raster& raster : rasters) {
    const auto found = std::ranges::find_if(
        lattices, [&](const auto& lattice) { return is_same_lattice(*lattice[0], raster); });
    if (found == lattices.end()) {
      lattices.push_back({&raster});
    } else {
      found->push_back(&raster);
    }
  }
  std::ranges::stable_sort(lattices, {},
                           [](const auto& lattice) { return lattice[0]->step_latitude_deg; });
  Judge judge(sd_m, accept_seams);
  Mosaic mosaic;
  for (const auto& lattice : lattices) {
    Sheet sheet(lattice);
    sheet.judge(judge);
    mosaic.grids.push_back(sheet.take(sd_m));
  }
  for (std::size_t fine = 0; fine < lattices.size(); ++fine) {
    for (std::size_t coarse = fine + 1; coarse < lattices.size(); ++coarse) {
      judge.judge(lattices[fine][0]->name, lattices[coarse][0]->name,
                  compare(mosaic.grids[fine], mosaic.grids[coarse]), "have models that overlap at");
    }
  }
  mosaic.notes = judge.notes;
  return mosaic;
}

}  // namespace ols::land
