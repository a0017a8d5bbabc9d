#include "edge/skyline/picture_evidence.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "edge/skyline/skyline_finder.h"

namespace ols::skyline {
namespace {

// How much the steps of the sky vary: in the uppermost sixth of the picture.
double sky_sd(const StripSteps& steps) {
  constexpr double kSigma = 1.4826, kLeast = 0.5;
  std::vector<float> sizes;
  for (int strip = 0; strip < steps.strips(); strip += 4) {
    for (int row = StripSteps::kHalf; row < steps.rows() / 6; row += StripSteps::kHalf) {
      sizes.push_back(std::abs(steps.of(strip)[row]));
    }
  }
  if (sizes.empty()) return kLeast;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::ranges::nth_element(sizes, middle);
  return std::max(kLeast, kSigma * *middle);
}

bool is_greatest(const float* step, int row, int rows) {
  for (int i = std::max(0, row - StripSteps::kHalf);
       i <= std::min(rows - 1, row + StripSteps::kHalf); ++i) {
    if (std::abs(step[i]) > std::abs(step[row])) return false;
  }
  return true;
}

// The probability of each row to be the first clear step, as edge_probabilities() gives them.
cv::Mat first_steps(const cv::Mat& picture) {
  constexpr int kWide_px = 9;  // along the edge, against noise
  cv::Mat gray;
  cv::blur(picture, gray, {kWide_px, 1});
  constexpr double kFaint = 3.0, kClear = 8.0, kMost = 0.7;  // sigmas; probability of a clear step
  const StripSteps steps(gray);
  const double sd = sky_sd(steps);
  cv::Mat p = cv::Mat::zeros(steps.strips(), steps.rows() + 2, CV_32F);
  for (int strip = 0; strip < p.rows; ++strip) {
    const float* step = steps.of(strip);
    float* out = p.ptr<float>(strip) + 1;
    double left = 1.0;
    for (int row = StripSteps::kHalf; row + StripSteps::kHalf <= steps.rows(); ++row) {
      const double sigmas = std::abs(step[row]) / sd;
      if (sigmas < kFaint || !is_greatest(step, row, steps.rows())) continue;
      const double here = left * kMost * std::min(1.0, (sigmas - kFaint) / (kClear - kFaint));
      out[row] = static_cast<float>(here);
      left -= here;
    }
    out[steps.rows()] = static_cast<float>(left);
  }
  return p;
}

cv::Mat mean_probabilities(const cv::Mat& picture) {
  cv::Mat sum;
  for (const int channel : {0, 2}) {  // blue, red
    cv::Mat gray;
    cv::extractChannel(picture, gray, channel);
    for (const cv::Mat& p : {edge_probabilities(gray), first_steps(gray)}) {
      sum = sum.empty() ? p : sum + p;
    }
  }
  return sum / 4.0;
}

// Above that of anywhere.
float log_ratio(double ratio) {
  constexpr double kElsewhere = 0.15;  // the edge that was found is none, or another
  return static_cast<float>(std::log((1.0 - kElsewhere) * ratio + kElsewhere));
}

double sd_of(int level) { return level == 0 ? 0.7 : std::exp2(level - 1); }

// Of the cells of one column from the one before the picture to the one after it; those beyond have
// the value of these.
std::vector<float> blurred(const std::vector<double>& cells, double sd) {
  const int reach = static_cast<int>(std::ceil(2.5 * sd)),
            last = static_cast<int>(cells.size()) - 1;
  std::vector<double> weights;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    weights.push_back(std::exp(-0.5 * i * i / (sd * sd)));
    sum += weights.back();
  }
  std::vector<float> result;
  for (int row = 0; row <= last; ++row) {
    double value = 0.0;
    for (int i = -reach; i <= reach; ++i) {
      value += weights[static_cast<std::size_t>(i + reach)] / sum *
               cells[static_cast<std::size_t>(std::clamp(row + i, 0, last))];
    }
    result.push_back(log_ratio(value));
  }
  return result;
}

}  // namespace

int PictureEvidence::level_for(double sd_cells) {
  return sd_cells < 0.7
             ? 0
             : std::min(kLevels - 1, 1 + static_cast<int>(std::lround(std::log2(sd_cells))));
}

PictureEvidence::PictureEvidence(const cv::Mat& picture, int cell_px)
    : cell_px_(cell_px),
      columns_(picture.cols / cell_px),
      rows_(picture.rows / cell_px),
      margin_(picture.rows / cell_px) {
  const cv::Mat p = mean_probabilities(picture);
  for (int column = 0; column < columns_; ++column) {
    const int first = column * cell_px / kStrip_px;
    const int end = std::min(p.rows, (column + 1) * cell_px / kStrip_px);
    cv::Mat mean;
    cv::reduce(p.rowRange(first, end), mean, 0, cv::REDUCE_AVG);
    const float* in = mean.ptr<float>();
    std::vector<double> cells(static_cast<std::size_t>(rows_) + 2, 0.0);
    cells.front() = in[0];
    cells.back() = in[picture.rows + 1];
    for (int row = 0; row < rows_ * cell_px; ++row) {
      cells[static_cast<std::size_t>(row / cell_px) + 1] +=
          rows_ * static_cast<double>(in[row + 1]);
    }
    for (int level = 0; level < kLevels; ++level) {
      const std::vector<float> column_cells = blurred(cells, sd_of(level));
      std::vector<float>& all = levels_[level];
      const auto margin = static_cast<std::size_t>(margin_);
      all.insert(all.end(), margin, column_cells.front());
      all.insert(all.end(), column_cells.begin() + 1, column_cells.end() - 1);
      all.insert(all.end(), margin, column_cells.back());
    }
  }
}

}  // namespace ols::skyline
