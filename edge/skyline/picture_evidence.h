// Where the edge between sky and land may be in one photograph, if neither its direction nor the
// land is known. Pure.
//
// In each cell of a grid over the picture stands the logarithm of how much likelier the skyline is
// there than anywhere, at several levels: on level n the skyline is expected in the cell with a
// 1-sigma of 2^(n-1) cells up and down, because the land's model errs. The likelihood is the mean
// of several ways to find the edge, because each of them fails in some pictures: the edge between
// two textures fails where haze smooths a far crest, the first clear step below the top of the
// picture fails before clouds; and a far crest differs from the sky mostly in red, a wood mostly in
// blue.
#pragma once

#include <opencv2/core.hpp>
#include <vector>

namespace ols::skyline {

class PictureEvidence {
 public:
  // `picture`: 8 bit, blue, green, red. `cell_px`: size of a cell.
  PictureEvidence(const cv::Mat& picture, int cell_px);

  int columns() const { return columns_; }
  int rows() const { return rows_; }
  int cell_px() const { return cell_px_; }
  // The column's cells, contiguous. There are margin() cells before this first one of the picture,
  // and as many after the last.
  const float* cells(int level, int column) const {
    return levels_[static_cast<std::size_t>(level)].data() + column * (rows_ + 2 * margin_) +
           margin_;
  }
  int margin() const { return margin_; }
  // For an elevation with this 1-sigma [cells].
  static int level_for(double sd_cells);

  static constexpr int kLevels = 6;

 private:
  int cell_px_, columns_, rows_, margin_;
  std::vector<float> levels_[kLevels];
};

}  // namespace ols::skyline
