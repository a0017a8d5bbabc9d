#include "edge/skyline/skyline_finder.h"

#include <algorithm>
#include <cmath>

namespace ols::skyline {
namespace {

using Steps = StripSteps;
constexpr int kHalf = Steps::kHalf;
constexpr double kSlack_px = 12;  // searched beyond three sigmas of the expected row

// The logarithm of the density of a normal distribution, but for a constant. Limited, so that a
// bird or a lamp counts as unlikely, not as impossible.
double log_normal(double value, double sd) {
  constexpr double kLeast = -12.0;
  return std::max(kLeast, -0.5 * (value / sd) * (value / sd)) - std::log(sd);
}

// The sky is mostly brighter than the land.
double log_edge(double step) {
  constexpr double kContrast = 40.0, kBrighter = 0.9;  // [gray]
  return std::log((step > 0.0 ? kBrighter : 1.0 - kBrighter) / kContrast);
}

// Of a row that is so many sigmas off the expected one. The skyline may be another crest, or a
// tree.
float log_expected(double sigmas) {
  constexpr double kAnother = -8.0;
  return static_cast<float>(std::max(kAnother, -0.5 * sigmas * sigmas));
}

double median_size(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle, {}, [](float value) { return std::abs(value); });
  return std::abs(*middle);
}

// The rows that are searched: the same number on both sides of the expected row of each strip.
struct Band {
  int reach = 0;
  std::vector<int> middle;  // of each strip that is known

  int states() const { return 2 * reach + 1; }
  int row(int strip, int state) const {
    return middle[static_cast<std::size_t>(strip)] + state - reach;
  }
};

Band band_of(const Rows& expected, int rows) {
  Band band;
  double reach = 0.0;
  for (const auto& one : expected) {
    band.middle.push_back(one ? static_cast<int>(std::lround(one->at_px)) : 0);
    if (one) reach = std::max(reach, 3.0 * one->sd_px + kSlack_px);
  }
  band.reach = static_cast<int>(std::min<double>(reach, rows));
  return band;
}

// How much the brightness changes from row to row in the sky and in the land of this picture.
struct Texture {
  double sky_sd = 0.0, land_sd = 0.0;  // of a step
};

Texture texture_of(const Steps& steps, const Rows& expected, const Band& band) {
  constexpr double kSigma = 1.4826, kLeast = 0.3;
  // Surely sky, surely land: what is farthest from the expected row, where the picture has it.
  std::vector<float> sky, land;
  const int margin = std::max(kHalf, band.reach / 3);
  for (std::size_t strip = 0; strip < expected.size(); ++strip) {
    if (!expected[strip]) continue;
    const float* step = steps.of(static_cast<int>(strip));
    const int middle = band.middle[strip];
    for (int row = kHalf; row <= steps.rows() - kHalf; row += kHalf) {
      if (row < middle - margin) sky.push_back(step[row]);
      if (row > middle + margin) land.push_back(step[row]);
    }
  }
  const auto sd_of = [](std::vector<float>& values) {
    constexpr std::size_t kFew = 200;
    return values.size() < kFew ? 0.0 : kSigma * median_size(std::move(values));
  };
  const double sky_sd = sd_of(sky), land_sd = sd_of(land);
  return {std::max(kLeast, sky_sd > 0.0 ? sky_sd : land_sd),
          std::max(kLeast, land_sd > 0.0 ? land_sd : sky_sd)};
}

// Of the brightness of one row.
double row_sd(double step_sd) { return step_sd * std::sqrt(0.5 * kHalf); }

// The log-likelihood of each state of one strip. The steps of 2 kHalf rows share their pixels, so
// that they count as one.
std::vector<float> log_likelihoods(const float* step, const Texture& texture, int rows) {
  std::vector<double> sky(static_cast<std::size_t>(rows) + 1), land(sky.size());
  for (int row = 0; row < rows; ++row) {
    const auto at = static_cast<std::size_t>(row);
    const bool known = row >= kHalf && row + kHalf <= rows;
    sky[at + 1] = sky[at] + (known ? log_normal(step[row], texture.sky_sd) : 0.0);
    land[at + 1] = land[at] + (known ? log_normal(step[row], texture.land_sd) : 0.0);
  }
  std::vector<float> log_p(static_cast<std::size_t>(rows));
  const auto end = static_cast<std::size_t>(rows);
  for (std::size_t row = 0; row < end; ++row) {
    const double above = sky[row > kHalf ? row - kHalf : 0];
    const double below = land[end] - land[std::min(end, row + kHalf)];
    log_p[row] = static_cast<float>((above + below) / (2 * kHalf) + log_edge(step[row]));
  }
  // Before the first and after the last entry the edge is outside: all land, all sky.
  log_p.insert(log_p.begin(), static_cast<float>(land[end] / (2 * kHalf)));
  log_p.push_back(static_cast<float>(sky[end] / (2 * kHalf)));
  return log_p;
}

// Scaled so that the likeliest state has 1.
cv::Mat likelihoods(const Steps& steps, const Rows& expected, const Band& band,
                    const Texture& texture) {
  constexpr float kTrust = 0.5F;  // textures are not as independent as the model has it
  cv::Mat all(static_cast<int>(expected.size()), band.states(), CV_32F, cv::Scalar(1.0));
  for (int strip = 0; strip < all.rows; ++strip) {
    const auto& one = expected[static_cast<std::size_t>(strip)];
    if (!one) continue;
    const auto log_p = log_likelihoods(steps.of(strip), texture, steps.rows());
    float* out = all.ptr<float>(strip);
    for (int state = 0; state < band.states(); ++state) {
      const int row = band.row(strip, state);
      const int entry = steps.has(row) ? row + 1 : row < steps.rows() / 2 ? 0 : steps.rows() + 1;
      const double off = (row - one->at_px) / one->sd_px;
      out[state] = kTrust * log_p[static_cast<std::size_t>(entry)] + log_expected(off);
    }
    const float best = *std::max_element(out, out + band.states());
    std::transform(out, out + band.states(), out, [best](float v) { return std::exp(v - best); });
  }
  return all;
}

// From one strip to the next the offset from the expected row changes little, or anyhow.
void spread(const float* from, float* to, int states) {
  constexpr double kChange_px = 4.0, kAnyhow = 0.02;
  static const auto kKept = static_cast<float>(std::exp(-1.0 / kChange_px));
  const float gain = (1.0F - kKept) / (1.0F + kKept);
  double sum = 0.0;
  float carried = 0.0F;
  for (int i = 0; i < states; ++i) {
    to[i] = carried;  // from the states before
    carried = kKept * (carried + from[i]);
    sum += from[i];
  }
  const auto anyhow = static_cast<float>(kAnyhow * sum / states);
  carried = 0.0F;
  for (int i = states - 1; i >= 0; --i) {
    to[i] = static_cast<float>(1.0 - kAnyhow) * gain * (to[i] + from[i] + carried) + anyhow;
    carried = kKept * (carried + from[i]);
  }
}

void normalise(float* p, int states) {
  double sum = 0.0;
  for (int i = 0; i < states; ++i) sum += p[i];
  for (int i = 0; i < states; ++i) p[i] = static_cast<float>(p[i] / sum);
}

// The probability of each state of each strip, given all strips.
cv::Mat posterior(const cv::Mat& likelihood) {
  cv::Mat forward = likelihood.clone(), result = likelihood.clone();
  const int states = likelihood.cols;
  std::vector<float> spread_to(static_cast<std::size_t>(states)), back(spread_to.size(), 1.0F);
  for (int strip = 0; strip < likelihood.rows; ++strip) {
    float* here = forward.ptr<float>(strip);
    if (strip > 0) {
      spread(forward.ptr<float>(strip - 1), spread_to.data(), states);
      for (int i = 0; i < states; ++i) here[i] *= spread_to[static_cast<std::size_t>(i)];
    }
    normalise(here, states);
  }
  for (int strip = likelihood.rows - 1; strip >= 0; --strip) {
    float* here = result.ptr<float>(strip);
    for (int i = 0; i < states; ++i)
      here[i] = forward.at<float>(strip, i) * back[static_cast<std::size_t>(i)];
    normalise(here, states);
    for (int i = 0; i < states; ++i)
      spread_to[static_cast<std::size_t>(i)] =
          likelihood.at<float>(strip, i) * back[static_cast<std::size_t>(i)];
    normalise(spread_to.data(), states);
    spread(spread_to.data(), back.data(), states);
  }
  return result;
}

// The likeliest state, if it is likely.
std::optional<int> sure_state(const float* p, int states) {
  constexpr int kNear = 2 * kHalf;
  constexpr double kSure = 0.9;
  const auto best = static_cast<int>(std::max_element(p, p + states) - p);
  double mass = 0.0;
  for (int i = std::max(0, best - kNear); i <= std::min(states - 1, best + kNear); ++i)
    mass += p[i];
  return mass >= kSure ? std::optional(best) : std::nullopt;
}

// To a fraction of a pixel: how many of the rows around `row` have the sky's brightness. The
// levels are those of the rows beyond.
std::optional<Row> refine(const float* b, int rows, int row, const Texture& texture) {
  constexpr int kEdge = 6, kLevel = 5;  // [px]
  constexpr double kClear = 5.0;        // sigmas of a step
  constexpr double kLeast_px = 0.25;
  const int first = row - kEdge, last = row + kEdge;  // [first, last)
  if (first < kLevel || last + kLevel > rows) return std::nullopt;
  double sky = 0.0, land = 0.0, covered = 0.0;
  for (int i = 0; i < kLevel; ++i) {
    sky += b[first - 1 - i] / kLevel;
    land += b[last + i] / kLevel;
  }
  const double contrast = sky - land;
  if (std::abs(contrast) < kClear * texture.sky_sd) return std::nullopt;
  for (int i = first; i < last; ++i) covered += std::clamp((b[i] - land) / contrast, -0.2, 1.2);
  const double noise = std::hypot(row_sd(texture.sky_sd), row_sd(texture.land_sd));
  return Row{first - 0.5 + covered, std::hypot(kLeast_px, noise * std::sqrt(kEdge) / contrast)};
}

}  // namespace

cv::Mat edge_probabilities(const cv::Mat& gray) {
  // As if each row were expected alike.
  const Rows anywhere(static_cast<std::size_t>(strips_of(gray.cols)),
                      Row{0.5 * gray.rows, 100.0 * gray.rows});
  const Steps steps(gray);
  const Band band = band_of(anywhere, gray.rows);
  const Texture texture = texture_of(steps, anywhere, band);
  const cv::Mat p = posterior(likelihoods(steps, anywhere, band, texture));
  cv::Mat result = cv::Mat::zeros(p.rows, gray.rows + 2, CV_32F);
  for (int strip = 0; strip < p.rows; ++strip) {
    for (int state = 0; state < p.cols; ++state) {
      const int entry = std::clamp(band.row(strip, state), -1, gray.rows) + 1;
      result.at<float>(strip, entry) += p.at<float>(strip, state);
    }
  }
  return result;
}

Rows find_skyline(const cv::Mat& gray, const Rows& expected) {
  Rows found(expected.size());
  const Steps steps(gray);
  const Band band = band_of(expected, gray.rows);
  if (band.reach == 0) return found;
  const Texture texture = texture_of(steps, expected, band);
  const cv::Mat p = posterior(likelihoods(steps, expected, band, texture));
  for (int strip = 0; strip < p.rows; ++strip) {
    const auto at = static_cast<std::size_t>(strip);
    const auto state = sure_state(p.ptr<float>(strip), p.cols);
    if (!expected[at] || !state || !steps.has(band.row(strip, *state))) continue;
    found[at] = refine(steps.brightness(strip), gray.rows, band.row(strip, *state), texture);
  }
  return found;
}

}  // namespace ols::skyline
