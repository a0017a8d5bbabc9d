// Measures how much the target has grown or shrunk, even if its appearance has changed. It is a
// one-dimensional correlation filter over images of the box at neighbouring sizes: M. Danelljan, G.
// Hager, F. S. Khan, M. Felsberg, "Discriminative scale space tracking", PAMI 39(8), 2017.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <opencv2/core.hpp>
#include <optional>

namespace ols::tracker {

class ScaleFilter {
 public:
  static constexpr int kSizes = 17;
  static constexpr double kStep = 1.03;  // ratio of neighbouring sizes
  static constexpr int kFrequencies = kSizes / 2 + 1;
  using Samples = Eigen::MatrixXf;   // one feature per row, one size per column
  using Spectra = Eigen::MatrixXcf;  // one feature per row, one frequency per column

  // The spectra of the box at the neighbouring sizes. nullopt if the box has too few pixels to show
  // its size, or if there is hardly any structure along its border.
  static std::optional<Spectra> look_at(const cv::Mat& gray, const Eigen::Vector2d& pixel,
                                        const Eigen::Vector2d& size_px);
  // The natural logarithm of the ratio of the target's size to the size of the box in `seen`; 0
  // before anything is learnt.
  double growth(const Spectra& seen) const;
  // Learns from `seen`, in which the target's size differs from the box's by this growth (a natural
  // logarithm, as above).
  void learn(const Spectra& seen, double growth, double interval_s);
  bool empty() const { return energy_.size() == 0; }

 private:
  Spectra numerator_;
  Eigen::VectorXf energy_;  // for each frequency
};

}  // namespace ols::tracker
