// The parameters of the visual tracker, with their defaults.
#pragma once

namespace ols::config {
struct Section;
}
namespace ols::tracker {

enum class TrackerMode {
  kPaper,  // the paper's section 5, literally
  kFull,
};

// Standard deviations of the noise in eq. (2)-(4) in the mode "paper", per frame.
struct PaperTrackerConfig {
  double position_sd_px = 2.0;
  double velocity_sd_px_s = 20.0;
  double size_sd_px = 0.2;
  // Eq. (5) is a sum over 576 pixels. Pixels of sky match everywhere, so a wrong patch has hardly
  // less weight than the target. The paper gives no scale; here, weights are raised to this power.
  // 1 gives the paper as printed.
  double weight_power = 100.0;
};

struct TrackerConfig {
  TrackerMode mode = TrackerMode::kFull;
  PaperTrackerConfig paper;
  int particles = 300;

  // Motion model, eq. (2)-(4): standard deviations of its noise in full-frame pixels.
  double position_sd_px = 1.0;         // per frame
  double position_sd_fraction = 0.04;  // per frame, relative to the box's size; added to the above
  double velocity_gain = 0.4;          // share of the position noise that is added to the velocity
  double velocity_sd_px_s = 5.0;       // per frame; the velocity's own noise
  double surprise_fraction = 0.2;      // share of the particles that get larger position noise,
  double surprise_scale = 4.0;         // larger by this factor
  double size_sd_fraction = 0.01;      // per frame, relative to the box's width and height
  double size_prior_sd_fraction = 0.35;  // prior of the box's size, relative to its first size
  double initial_velocity_sd_px_s = 60.0;

  // Objective, eq. (5): a patch of background has exp(-sharpness) times the likelihood of the
  // template.
  double sharpness = 8.0;
  // The same for a patch that is not correlated with the template. Eq. (5) sums over the whole box.
  // If the target fills a tenth of it, nine tenths are sky that matches everywhere, and only the
  // correlation distinguishes the two.
  double correlation_sharpness = 20.0;

  // The same for a place that lacks the target's usual contrast.
  double contrast_sharpness = 6.0;
  // Time constant with which the target's appearance is learnt.
  double learning_time_s = 0.5;

  // Ego-motion between adjacent frames.
  int ego_motion_width_px = 640;  // maximum width of the reduced image
  int ego_motion_corners = 120;
  int ego_motion_least_inliers = 12;
  double ego_motion_least_inlier_fraction = 0.4;
  double unknown_motion_sd_px = 2.0;  // additional position noise without a homography

  // Share of the particles that are moved to the maxima of the frame difference if there is no
  // homography, or while the target's velocity is unknown. They are moved by at most
  // leap_most_px_s.
  double difference_fraction = 0.2;
  double leap_most_px_s = 1500.0;
  // Share of the particles that are redrawn over the search region while the target is not
  // believed.
  double search_fraction = 0.4;
  double search_growth_px_s = 40.0;
  double search_sd_most_px = 120.0;

  double reference_interval_s = 0.3;  // interval between images that are kept for foreground masks
  double pixel_sd_floor_px = 0.005;   // least 1-sigma of the refined position
};

config::Section tracker_section(TrackerConfig& config);  // the section [tracker]

}  // namespace ols::tracker
