#include "sim/sensors/nmea.h"

#include <algorithm>
#include <cmath>
#include <ctime>

#include "conditions/printed.h"
#include "geometry/angles.h"

namespace ols::sim {

namespace {

std::tm civil(std::int64_t utime_us) {
  const std::time_t seconds = static_cast<std::time_t>(utime_us / 1'000'000);
  std::tm out{};
  gmtime_r(&seconds, &out);
  return out;
}

std::string time_of_day(std::int64_t utime_us) {
  const std::tm t = civil(utime_us);
  const int hundredths = static_cast<int>(utime_us % 1'000'000 / 10'000);
  return printed("%02d%02d%02d.%02d", t.tm_hour, t.tm_min, t.tm_sec, hundredths);
}

std::string date(std::int64_t utime_us) {
  const std::tm t = civil(utime_us);
  return printed("%02d%02d%02d", t.tm_mday, t.tm_mon + 1, t.tm_year % 100);
}

// Degrees, minutes to 1e-7 (0.2 mm), hemisphere.
std::string angle(double rad, int degree_digits, const char* hemispheres) {
  const std::int64_t units = std::llround(std::abs(degrees(rad)) * 60e7);
  const std::int64_t per_degree = 600'000'000;
  const auto whole_deg = static_cast<int>(units / per_degree);
  return printed("%0*d%010.7f,%c", degree_digits, whole_deg,
                 1e-7 * static_cast<double>(units % per_degree),
                 rad < 0.0 ? hemispheres[1] : hemispheres[0]);
}

std::string position(const NmeaEpoch& e) {
  if (!e.has_fix) return ",,,";
  return angle(e.antenna.latitude_rad, 2, "NS") + "," + angle(e.antenna.longitude_rad, 3, "EW");
}

std::string gga(const NmeaEpoch& e) {
  const std::string head = "GNGGA," + time_of_day(e.utime_us) + "," + position(e) + ",";
  if (!e.has_fix) return head + "0,00,99.99,,,,,,";
  const char* correction = e.quality >= 2 ? "1.0,0001" : ",";
  return head + printed("%d,%02d,0.70,%.4f,M,%.4f,M,%s", e.quality,
                        e.gps_satellites + e.glonass_satellites, e.antenna.height_m - e.geoid_m,
                        e.geoid_m, correction);
}

struct System {
  const char* talker;
  int id;     // of GSA's last field
  int first;  // number of its first satellite; GLONASS' begin at 65
};
constexpr System kGps{"GP", 1, 1};
constexpr System kGlonass{"GL", 2, 65};

std::string gsa(const NmeaEpoch& e, const System& system, int satellites) {
  std::string text = e.has_fix ? "GNGSA,A,3" : "GNGSA,A,1";
  for (int i = 0; i < 12; ++i) {
    const bool used = e.has_fix && i < satellites;
    text += used ? printed(",%02d", system.first + i) : std::string(",");
  }
  return text + (e.has_fix ? ",1.20,0.70,1.00," : ",99.99,99.99,99.99,") +
         std::to_string(system.id);
}

// All satellites of one system in view, four per sentence.
std::string gsv(const System& system, int satellites) {
  const int sentences = (satellites + 3) / 4;
  std::string out;
  for (int s = 0; s < sentences; ++s) {
    std::string text = printed("%sGSV,%d,%d,%02d", system.talker, sentences, s + 1, satellites);
    for (int i = 4 * s; i < std::min(4 * s + 4, satellites); ++i) {
      text += printed(",%02d,%02d,%03d,%02d", system.first + i, 20 + 5 * i, 25 * i, 38 + i);
    }
    out += nmea_sentence(text + ",1");  // signal 1: L1 of both
  }
  return out;
}

std::string gst(const NmeaEpoch& e) {
  const std::string head = "GNGST," + time_of_day(e.utime_us) + ",";
  if (!e.has_fix) return head + ",,,,,,";
  const Eigen::Vector3d& sd = e.sd_enu_m;
  return head + printed("%.4f,%.4f,%.4f,0.0,%.4f,%.4f,%.4f", sd.norm(), std::max(sd.x(), sd.y()),
                        std::min(sd.x(), sd.y()), sd.y(), sd.x(), sd.z());
}

std::string rmc(const NmeaEpoch& e) {
  const char* mode = !e.has_fix ? "N" : e.quality == 4 ? "R" : e.quality == 5 ? "F" : "A";
  return "GNRMC," + time_of_day(e.utime_us) + (e.has_fix ? ",A," : ",V,") + position(e) +
         (e.has_fix ? ",0.00,," : ",,,") + date(e.utime_us) + ",,," + mode + ",V";
}

}  // namespace

std::string nmea_sentence(const std::string& text) {
  unsigned sum = 0;
  for (const char c : text) sum ^= static_cast<unsigned char>(c);
  return "$" + text + printed("*%02X\r\n", sum);
}

std::string nmea_epoch(const NmeaEpoch& epoch) {
  return nmea_sentence(rmc(epoch)) + nmea_sentence(gga(epoch)) +
         nmea_sentence(gsa(epoch, kGps, epoch.gps_satellites)) +
         nmea_sentence(gsa(epoch, kGlonass, epoch.glonass_satellites)) +
         gsv(kGps, epoch.gps_satellites) + gsv(kGlonass, epoch.glonass_satellites) +
         nmea_sentence(gst(epoch));
}

}  // namespace ols::sim
