// Parameters of the visual tracker with their defaults.
#pragma once

namespace ols::config {
struct Section;
}
namespace ols::tracker {

enum class TrackerMode {
  kPaper,  // the paper's section 5, word for word
  kFull,
};

// Standard deviations of eq. (2)-(4)'s noise in the mode "paper", per frame.
struct PaperTrackerConfig {
  double position_sd_px = 2.0;
  double velocity_sd_px_s = 20.0;
  double size_sd_px = 0.2;
  // Eq. (5) is a sum over 576 pixels, of which the sky's fit everywhere: a wrong patch weighs
  // hardly less than the target. The paper gives no scale; its weights are raised to this power. 1
  // is the letter of the paper.
  double weight_power = 100.0;
};

struct TrackerConfig {
  TrackerMode mode = TrackerMode::kFull;
  PaperTrackerConfig paper;
  int particles = 300;

  // Motion model, eq. (2)-(4): standard deviations of its noise. Pixels are those of the full
  // frame.
  double position_sd_px = 1.0;           // per frame
  double position_sd_fraction = 0.04;    // of the box's size, per frame, added to the above
  double velocity_gain = 0.4;            // part of the position's noise that the velocity shares
  double velocity_sd_px_s = 5.0;         // px/s, per frame, the rest
  double surprise_fraction = 0.2;        // of the particles: their position's noise is larger,
  double surprise_scale = 4.0;           // by this
  double size_sd_fraction = 0.01;        // of the box's width and height, per frame
  double size_prior_sd_fraction = 0.35;  // how far from its first size the box is believed to go
  double initial_velocity_sd_px_s = 60.0;

  // Objective, eq. (5): a background patch is exp(-sharpness) as likely as the template.
  double sharpness = 8.0;
  // The same for an uncorrelated patch. Eq. (5) sums over the whole box: of a target that fills a
  // tenth of it, nine tenths are sky that fits everywhere, and only the correlation tells.
  double correlation_sharpness = 20.0;

  // The same for a place that does not stand out of its surroundings as the target does.
  double contrast_sharpness = 6.0;
  // Time constant of learning the target's look.
  double learning_time_s = 0.5;

  // Ego-motion between adjacent frames.
  int ego_motion_width_px = 640;  // reduced image, at most
  int ego_motion_corners = 120;
  int ego_motion_least_inliers = 12;
  double ego_motion_least_inlier_fraction = 0.4;
  double unknown_motion_sd_px = 2.0;  // more position noise where no homography is known

  // Share of the particles forced onto the maxima of the frame difference without a homography, or
  // while the target's velocity is not known, as far as it could leap.
  double difference_fraction = 0.2;
  double leap_most_px_s = 1500.0;
  // Share redrawn over the search region while the target is not believed in.
  double search_fraction = 0.4;
  double search_growth_px_s = 40.0;
  double search_sd_most_px = 120.0;

  double reference_interval_s = 0.3;  // between images kept for the foreground masks
  double pixel_sd_floor_px = 0.005;   // of the refined position
};

config::Section tracker_section(TrackerConfig& config);  // [tracker]

}  // namespace ols::tracker
