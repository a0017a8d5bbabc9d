#include "cue/cue_config.h"

#include <algorithm>
#include <span>
#include <stdexcept>

#include "base/config/config_common.h"
#include "cue/source.h"

namespace ols::cues {
namespace {

struct FormatRow {
  Format format;
  const char* name;
  std::vector<Carrier> carriers;
};

const std::vector<FormatRow>& formats() {
  static const std::vector<FormatRow> kFormats{
      {Format::kCot, "cot", {Carrier::kUdp, Carrier::kTcp}},
      {Format::kAircraftJson, "aircraft-json", {Carrier::kFile, Carrier::kHttp}},
      {Format::kSbs, "sbs", {Carrier::kTcp}},
      {Format::kJson, "json", {Carrier::kUdp, Carrier::kTcp}},
      {Format::kSapient, "sapient", {Carrier::kTcp}}};
  return kFormats;
}

const FormatRow& row_of(Format format) {
  return *std::ranges::find(formats(), format, &FormatRow::format);
}

void check_input(const InputConfig& input, ConfigTable& table) {
  const FormatRow& format = row_of(input.format);
  try {
    const Source source = parse_source(input.from);
    if (std::ranges::find(format.carriers, source.carrier) == format.carriers.end()) {
      throw std::invalid_argument(std::string("the format ") + format.name +
                                  " cannot be received that way");
    }
  } catch (const std::invalid_argument& bad) {
    throw table.error("from", bad.what());
  }
  config::check_area(input.rules.area_deg, "area_deg", table);
  if (input.format == Format::kCot && input.types.empty()) {
    throw table.error("types", "must not be empty");
  }
}

config::Section inputs_section(CueConfig& config) {
  return {"input", "A source; there is none by default.",      {}, {},
          {},      [&config] { return input_section(config); }};
}

void check_names(const CueConfig& config, ConfigTable& root) {
  std::vector<std::string> names;
  for (const InputConfig& input : config.inputs) names.push_back(input.rules.name);
  config::check_distinct(names, "input", root);
}

}  // namespace

config::Section input_section(CueConfig& config) {
  InputConfig& i = config.inputs.emplace_back();
  InputRules& r = i.rules;
  return {
      "",
      "",
      {config::text("name", r.name, "Name of the input; the ids of its cues begin with it.",
                    config::word_up_to(30))
           .required_with_section(),
       config::word("format", i.format, config::words_of(formats(), &FormatRow::format),
                    "Format of the source (docs/cues.md).")
           .required_with_section(),
       config::text("from", i.from,
                    "udp://ADDRESS:PORT?interface=ADDRESS, tcp://HOST:PORT, file:///PATH or "
                    "http://HOST/PATH.",
                    config::not_empty)
           .required_with_section(),
       config::number("poll_s", i.poll_s, {0.1, 60.0}, "s",
                      "Interval of reading a file or a web address."),
       config::texts("types", i.types, "Types of CoT events to use, or the beginnings of types."),
       config::numbers("area_deg", std::span<double>(r.area_deg), {-180.0, 180.0}, "deg",
                       "South, west, north, east: targets outside are refused."),
       config::number("max_age_s", r.max_age_s, {0.5, 60.0}, "s",
                      "Older reports, by this host's clock, are refused."),
       config::number("horizontal_sd_m", r.horizontal_sd_m, {0.1, 1e4}, "m",
                      "1-sigma of a position, east and north each, where the source states none."),
       config::number("vertical_sd_m", r.vertical_sd_m, {0.1, 1e4}, "m",
                      "1-sigma of a height where the source states none."),
       config::number("pressure_height_sd_m", r.pressure_height_sd_m, {0.1, 1e4}, "m",
                      "1-sigma of a height by pressure, taken as above the ellipsoid."),
       config::number("velocity_sd_m_s", r.velocity_sd_m_s, {0.1, 1e3}, "m/s",
                      "1-sigma of a velocity where the source states none."),
       config::number("speed_sd_m_s", r.speed_sd_m_s, {0.1, 1e3}, "m/s",
                      "1-sigma of the speed along each axis where the source states no velocity.")},
      {},
      [&i](ConfigTable& table) { check_input(i, table); }};
}

config::Section cue_section(CueConfig& c) {
  return {"",
          "",
          {config::bus_url(c.lcm_url),
           config::text("geoid", c.geoid,
                        "Grid of the geoid, by its name in PROJ's folders or by its path; for "
                        "SAPIENT sources with heights above the geoid.",
                        config::not_empty),
           config::status_file(c.status_file),
           config::integer(
               "most", c.most, 1, 64, "",
               "Maximum number of cues at the same time, shared equally among the inputs.")},
          {inputs_section(c), trust::trust_section(c.trust)},
          [&c](ConfigTable& root) { check_names(c, root); }};
}

CueConfig load_cue_config(const std::string& path) { return config::load(path, cue_section); }

CueConfig parse_cue_config(const std::string& text, const std::string& name) {
  return config::parse(text, name, cue_section);
}

const char* to_string(Format format) { return row_of(format).name; }

}  // namespace ols::cues
