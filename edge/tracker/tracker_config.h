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
  double position_sd_px = 1.0;  // per frame
  // Per frame, relative to the box's size; added to position_sd_px.
  double position_sd_fraction = 0.04;
  // The position noise, divided by the frame interval and multiplied by this gain, is added to the
  // velocity.
  double velocity_gain = 0.4;
  double velocity_sd_px_s = 5.0;   // per frame; the velocity's own noise
  double surprise_fraction = 0.2;  // share of the particles that get a larger position noise
  double surprise_scale = 4.0;     // factor by which their position noise is larger
  double size_sd_fraction = 0.01;  // per frame, relative to the box's width and height
  // 1-sigma of the prior of the box's size, relative to its usual size.
  double size_prior_sd_fraction = 0.35;
  double initial_velocity_sd_px_s = 60.0;

  // Objective, eq. (5): a patch of background has exp(-sharpness) times the likelihood of the
  // template.
  double sharpness = 8.0;
  // Likewise, a patch that is not correlated with the template has exp(-correlation_sharpness)
  // times its likelihood. Eq. (5) sums over the whole box: if the target fills a tenth of it, nine
  // tenths are sky, which matches everywhere. Only the correlation then shows whether the target is
  // there.
  double correlation_sharpness = 20.0;

  // Likewise, a place without the target's usual contrast has exp(-contrast_sharpness) times its
  // likelihood.
  double contrast_sharpness = 6.0;
  // Time constant with which the target's appearance is learnt.
  double learning_time_s = 0.5;

  // Ego-motion between adjacent frames.
  int ego_motion_width_px = 640;  // maximum width of the reduced image
  int ego_motion_corners = 120;
  int ego_motion_least_inliers = 12;
  double ego_motion_least_inlier_fraction = 0.4;
  double unknown_motion_sd_px = 2.0;  // additional position noise without a homography

  // Share of the particles that are moved to the maxima of the frame difference. This is done
  // without a homography, during a search, and while the target's velocity is unknown. With a
  // homography, leap_most_px_s limits how far they are moved.
  double difference_fraction = 0.2;
  double leap_most_px_s = 1500.0;
  // Share of the particles that are redrawn over the search region while the target is searched
  // for. search_growth_px_s: the rate at which the region's 1-sigma grows. search_sd_most_px: its
  // maximum.
  double search_fraction = 0.4;
  double search_growth_px_s = 40.0;
  double search_sd_most_px = 120.0;

  // Interval between the images that are stored for foreground masks.
  double reference_interval_s = 0.3;
  double pixel_sd_floor_px = 0.005;  // 1-sigma that is added in quadrature to every position
};

config::Section tracker_section(TrackerConfig& config);  // the section [tracker]

}  // namespace ols::tracker
