#include "tools/offline/fix_writer.h"

#include <array>
#include <charconv>
#include <cmath>

namespace ols {

FixWriter::FixWriter(const std::string& path) : file_(path) {
  file_.stream() << "utime_us,target,latitude_deg,longitude_deg,height_m,east_sd_m,north_sd_m,"
                    "up_sd_m,stations_used,stations_set_aside,crossing_angle_deg,residual\n";
}

// Not by the stream's own formatting, which takes several times as long.
void FixWriter::add(const FixRow& fix) {
  std::ostream& out = file_.stream();
  const auto decimal = [&](double value, int decimals) {
    std::array<char, 340> text{};  // the largest double has 309 digits before the point
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::fixed, decimals);
    out.write(text.data(), end.ptr - text.data());
  };
  out << fix.utime_us << ',' << fix.target;
  for (const double degrees : {fix.latitude_deg, fix.longitude_deg}) {
    out << ',';
    decimal(degrees, 9);  // a hundredth of a microdegree is a millimetre
  }
  for (const double metres : {fix.height_m, fix.east_sd_m, fix.north_sd_m, fix.up_sd_m}) {
    out << ',';
    decimal(metres, 4);
  }
  out << ',' << fix.stations_used << ',' << fix.stations_set_aside << ',';
  decimal(fix.crossing_angle_deg, 4);
  out << ',';
  if (!std::isnan(fix.residual)) decimal(fix.residual, 4);
  out << '\n';
}

void FixWriter::commit() { file_.commit(); }

}  // namespace ols
