#include "sim/scenario/scenario_relief.h"

#include <memory>

#include "edge/config/config_units.h"
#include "sim/scenario/scenario_places.h"

namespace ols::sim {
namespace {

using config::Section;

constexpr config::Range kPlace_m{-kFar_m, kFar_m};

// An array of tables, each an element of `all`.
template <class T, class Rows>
Section each(const char* name, const char* sentence, std::vector<T>& all, Rows rows) {
  Section section{name, sentence};
  section.append = [&all, rows] {
    auto one = std::make_shared<T>();
    return Section{"", "", rows(*one), {}, [&all, one](ConfigTable&) { all.push_back(*one); }};
  };
  return section;
}

config::Row heading(double& field, const char* sentence) {
  return config::number("heading_deg", field, {-360, 360}, station::in_degrees(), sentence);
}

config::Row centre(Eigen::Vector2d& field) {
  return config::numbers("centre_m", {field.data(), 2}, kPlace_m, "m",
                         "Its middle, east and north of the site's origin.")
      .required();
}

Section hills(std::vector<Hill>& all) {
  return each("hill", "A rounded hill.", all, [](Hill& h) {
    return std::vector{
        centre(h.centre_m),
        config::number("height_m", h.height_m, {-1000, 3000}, "m", "Of its top."),
        config::numbers("width_m", {h.width_m.data(), 2}, {1, 1e5}, "m",
                        "From its top to 0.6 of its height, along its heading and across."),
        heading(h.heading_rad, "Of its ridge, clockwise from north.")};
  });
}

Section houses(std::vector<House>& all) {
  return each("house", "A house with a level roof.", all, [](House& h) {
    return std::vector{centre(h.centre_m),
                       config::numbers("size_m", {h.size_m.data(), 3}, {0.5, 1000}, "m",
                                       "Length along its heading, width, height."),
                       heading(h.heading_rad, "Clockwise from north."),
                       config::flag("mapped", h.mapped, "Whether the model of the land has it.")};
  });
}

Section trees(std::vector<Tree>& all) {
  return each("tree", "A tree, which no model has.", all, [](Tree& t) {
    return std::vector{centre(t.centre_m),
                       config::number("height_m", t.height_m, {0.5, 100}, "m", "Its height."),
                       config::number("radius_m", t.radius_m, {0.1, 50}, "m", "Of its crown.")};
  });
}

Section model(LandModelScenario& m) {
  return {"model",
          "What the product may know of the land.",
          {config::number("reach_m", m.reach_m, {100, 10e3}, "m", "Of its heights, each way."),
           config::number("spacing_m", m.spacing_m, {1, 100}, "m", "Between its heights."),
           config::number("sd_m", m.sd_m, {0, 100}, "m", "1-sigma of its heights."),
           config::number("length_m", m.length_m, {1, 1e4}, "m", "Over which its errors change."),
           config::number("house_sd_m", m.house_sd_m, {0, 100}, "m",
                          "1-sigma of the heights of its houses."),
           config::number("outline_sd_m", m.outline_sd_m, {0, 100}, "m",
                          "1-sigma of the places of its houses, each axis.")}};
}

}  // namespace

Section relief_section(ReliefScenario& relief) {
  return {"relief",
          "The land that hides targets.",
          {config::number("roughness_m", relief.roughness_m, {0, 10}, "m",
                          "1-sigma of the ground's unevenness."),
           config::number("roughness_length_m", relief.roughness_length_m, {1, 1000}, "m",
                          "Length of its waves.")},
          {hills(relief.hills), houses(relief.houses), trees(relief.trees), model(relief.model)}};
}

}  // namespace ols::sim
