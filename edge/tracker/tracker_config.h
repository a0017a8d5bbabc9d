// Parameters of the visual tracker with their defaults.
#pragma once

namespace ols::config {
struct Section;
}
namespace ols::tracker {

enum class TrackerMode {
  kPaper,  // the paper's section 5, literally
  kFull,
};

// Standard deviations of the noise of eq. (2)-(4) in the mode "paper", per frame.
struct PaperTrackerConfig {
  double position_sd_px = 2.0;
  double velocity_sd_px_s = 20.0;
  double size_sd_px = 0.2;
  // Eq. (5) is a sum over 576 pixels. Pixels of sky match everywhere, so a wrong patch weighs
  // hardly less than the target. The paper gives no scale; weights are raised to this power. 1 is
  // the paper as printed.
  double weight_power = 100.0;
};

struct TrackerConfig {
  TrackerMode mode = TrackerMode::kFull;
  PaperTrackerConfig paper;
  int particles = 300;

  // Motion model, eq. (2)-(4): standard deviations of its noise, in pixels of the full frame.
  double position_sd_px = 1.0;           // for each frame
  double position_sd_fraction = 0.04;    // of the box's size, for each frame, added to the above
  double velocity_gain = 0.4;            // part of the position noise that the velocity shares
  double velocity_sd_px_s = 5.0;         // px/s, for each frame, the rest
  double surprise_fraction = 0.2;        // of the particles: larger position noise,
  double surprise_scale = 4.0;           // by this factor
  double size_sd_fraction = 0.01;        // of the box's width and height, for each frame
  double size_prior_sd_fraction = 0.35;  // prior of the box's deviation from its first size
  double initial_velocity_sd_px_s = 60.0;

  // Objective, eq. (5): a background patch has exp(-sharpness) times the template's likelihood.
  double sharpness = 8.0;
  // The same for an uncorrelated patch. Eq. (5) sums over the whole box: if the target fills a
  // tenth of it, nine tenths are sky that matches everywhere, and only the correlation
  // distinguishes them.
  double correlation_sharpness = 20.0;

  // The same for a place without the target's usual contrast.
  double contrast_sharpness = 6.0;
  // Time constant of learning the target's appearance.
  double learning_time_s = 0.5;

  // Ego-motion between adjacent frames.
  int ego_motion_width_px = 640;  // reduced image, maximum
  int ego_motion_corners = 120;
  int ego_motion_least_inliers = 12;
  double ego_motion_least_inlier_fraction = 0.4;
  double unknown_motion_sd_px = 2.0;  // additional position noise without a homography

  // Share of the particles moved to the maxima of the frame difference, without a homography or
  // while the target's velocity is unknown. At most up to the maximum leap.
  double difference_fraction = 0.2;
  double leap_most_px_s = 1500.0;
  // Share redrawn over the search region while the target is not believed.
  double search_fraction = 0.4;
  double search_growth_px_s = 40.0;
  double search_sd_most_px = 120.0;

  double reference_interval_s = 0.3;  // between images kept for the foreground masks
  double pixel_sd_floor_px = 0.005;   // minimum of the refined position
};

config::Section tracker_section(TrackerConfig& config);  // [tracker]

}  // namespace ols::tracker
