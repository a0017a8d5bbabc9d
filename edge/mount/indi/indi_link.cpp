#include "edge/mount/indi/indi_link.h"

#include <libindi/baseclient.h>
#include <libindi/basedevice.h>
#include <libindi/indiproperty.h>
#include <libindi/indipropertynumber.h>
#include <libindi/indipropertyswitch.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <initializer_list>
#include <limits>
#include <mutex>
#include <string_view>
#include <utility>

#include "base/process/clocks.h"
#include "base/text/plain_text.h"
#include "geometry/angles.h"

namespace ols::indi {
namespace {

constexpr double kHour_rad = kPi / 12.0;
constexpr double kBegins_s = 1.0;  // until a telescope says that it tracks
const double kArcSecond_rad = radians(1.0 / 3600.0);

// NaN: no such element.
double number_in(INDI::Property& property, const char* element) {
  const auto* const widget = property.getNumber()->findWidgetByName(element);
  return widget == nullptr ? std::nan("") : widget->getValue();
}

bool is_on(INDI::Property& property, const char* element) {
  const auto* const widget = property.getSwitch()->findWidgetByName(element);
  return widget != nullptr && widget->getState() == ISS_ON;
}

// The rate that both axes allow in both directions.
double fastest_in(INDI::Property& property) {
  double fastest_arcsec_s = std::numeric_limits<double>::max();
  for (const auto& axis : *property.getNumber())
    fastest_arcsec_s = std::min({fastest_arcsec_s, -axis.getMin(), axis.getMax()});
  return std::max(0.0, fastest_arcsec_s * kArcSecond_rad);
}

bool is_motion(std::string_view name) {
  return name == "TELESCOPE_TRACK_RATE" || name == "TELESCOPE_TRACK_MODE";
}
bool is_stop(std::string_view name) {
  return name == "TELESCOPE_TRACK_STATE" || name == "TELESCOPE_ABORT_MOTION";
}

// A driver that cannot read its telescope repeats the old position in state ALERT; one that answers
// an order repeats it, too. Neither is a new measurement.
void take_position(Heard& heard, INDI::Property& property) {
  const Equatorial seen{number_in(property, "RA") * kHour_rad, radians(number_in(property, "DEC"))};
  heard.slews = property.getState() == IPS_BUSY;
  const bool fits =
      seen.ra_rad >= 0.0 && seen.ra_rad <= 2.0 * kPi && std::abs(seen.dec_rad) <= kPi / 2.0;
  if (!fits || property.getState() == IPS_ALERT) {
    ++heard.positions_refused;
    return;
  }
  if (heard.position && heard.position->ra_rad == seen.ra_rad &&
      heard.position->dec_rad == seen.dec_rad)
    return;
  heard.position = seen;
  heard.position_s = clock_monotonic_s();
}

void take_observer(Heard& heard, INDI::Property& property) {
  const Observer observer{radians(number_in(property, "LAT")),
                          radians(number_in(property, "LONG"))};
  if (std::abs(observer.latitude_rad) <= kPi / 2.0 && std::abs(observer.longitude_rad) <= 2.0 * kPi)
    heard.observer = observer;
}

void take_numbers(Heard& heard, INDI::Property& property) {
  if (property.isNameMatch("GEOGRAPHIC_COORD")) take_observer(heard, property);
  if (property.isNameMatch("TELESCOPE_TRACK_RATE")) heard.fastest_rad_s = fastest_in(property);
}

void take_switches(Heard& heard, INDI::Property& property) {
  if (property.isNameMatch("CONNECTION")) heard.is_connected = is_on(property, "CONNECT");
  if (property.isNameMatch("TELESCOPE_TRACK_STATE")) {
    heard.can_stop_tracking = true;
    heard.tracks = is_on(property, "TRACK_ON");
  }
  if (property.isNameMatch("TELESCOPE_PARK")) {
    const bool under_way = property.getState() == IPS_BUSY;
    heard.is_parked = is_on(property, "PARK") && !under_way;
    heard.parks = is_on(property, "PARK") && under_way;
  }
  if (property.isNameMatch("TELESCOPE_PIER_SIDE")) {
    for (const char* side : {"PIER_WEST", "PIER_EAST"})
      if (is_on(property, side)) heard.pier_side = side;
  }
}

}  // namespace

// The library's thread writes its shared properties, so orders have properties of their own.
class IndiLink::Client : public INDI::BaseClient {
 public:
  Client(std::string host, int port, std::string device)
      : place_(host + ":" + std::to_string(port)), device_(std::move(device)) {
    setServer(host.c_str(), static_cast<unsigned>(port));
    watchDevice(device_.c_str());
  }
  ~Client() override { disconnectServer(); }

  const std::string& place() const { return place_; }

  Heard heard() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

  using Value = std::pair<const char*, double>;
  void order(const char* name, std::initializer_list<Value> values) {
    INDI::PropertyNumber property(values.size());
    property.setDeviceName(device_.c_str());
    property.setName(name);
    std::size_t at = 0;
    for (const auto& [element, value] : values) {
      property[at].setName(element);
      property[at++].setValue(value);
    }
    sendNewProperty(property);
  }
  void choose(const char* name, const char* element) {
    INDI::PropertySwitch property(1);
    property.setDeviceName(device_.c_str());
    property.setName(name);
    property[0].setName(element);
    property[0].setState(ISS_ON);
    sendNewProperty(property);
  }

 protected:
  void newDevice(INDI::BaseDevice /*device*/) override {
    const std::lock_guard lock(mutex_);
    heard_.has_device = true;
  }
  void removeDevice(INDI::BaseDevice /*device*/) override { lose(); }
  void serverDisconnected(int /*exit_code*/) override { lose(); }
  void newProperty(INDI::Property property) override { take(property); }
  // A position that comes with its definition is no measurement.
  void updateProperty(INDI::Property property) override {
    take(property);
    const std::lock_guard lock(mutex_);
    if (property.isNameMatch("EQUATORIAL_EOD_COORD") && property.getType() == INDI_NUMBER)
      take_position(heard_, property);
  }
  void newMessage(INDI::BaseDevice device, int id) override {
    const std::lock_guard lock(mutex_);
    heard_.message = plain_text(device.messageQueue(static_cast<std::size_t>(id)).substr(0, 200));
  }

 private:
  void lose() {
    const std::lock_guard lock(mutex_);
    heard_.lost = true;
  }
  void take(INDI::Property& property) {
    const std::lock_guard lock(mutex_);
    const bool refused = property.getState() == IPS_ALERT;
    if (refused && is_motion(property.getName())) ++heard_.motions_refused;
    if (refused && is_stop(property.getName())) ++heard_.stops_refused;
    if (property.getType() == INDI_NUMBER) take_numbers(heard_, property);
    if (property.getType() == INDI_SWITCH) take_switches(heard_, property);
  }

  const std::string place_, device_;
  mutable std::mutex mutex_;
  Heard heard_;
};

IndiLink::IndiLink(std::string host, int port, std::string device)
    : client_(std::make_unique<Client>(std::move(host), port, std::move(device))) {}
IndiLink::~IndiLink() = default;

// The library may write to a closed socket: SIGPIPE must not end the program.
void IndiLink::open() {
  std::signal(SIGPIPE, SIG_IGN);
  if (!client_->connectServer()) throw IndiError("no INDI server at " + client_->place());
}

Heard IndiLink::heard() const { return client_->heard(); }
void IndiLink::connect_telescope() { client_->choose("CONNECTION", "CONNECT"); }
void IndiLink::unpark() { client_->choose("TELESCOPE_PARK", "UNPARK"); }

void IndiLink::set_interval(double interval_s) {
  client_->order("POLLING_PERIOD", {{"PERIOD_MS", 1e3 * interval_s}});
}

// Some drivers abort only a slew.
void IndiLink::stop() {
  ordered_.reset();
  client_->choose("TELESCOPE_ABORT_MOTION", "ABORT");
  client_->choose("TELESCOPE_TRACK_STATE", "TRACK_OFF");
}

// INDI refuses to reverse a rate while the telescope tracks. Some drivers take a rate only while it
// tracks, so the rate is ordered again afterwards; otherwise the old one would stay in force.
void IndiLink::track(const TrackRate& rate) {
  const bool reverses = ordered_ && (ordered_->hour_angle_rad_s * rate.hour_angle_rad_s < 0.0 ||
                                     ordered_->dec_rad_s * rate.dec_rad_s < 0.0);
  const auto order = [&] {
    client_->order("TELESCOPE_TRACK_RATE",
                   {{"TRACK_RATE_RA", rate.hour_angle_rad_s / kArcSecond_rad},
                    {"TRACK_RATE_DE", rate.dec_rad_s / kArcSecond_rad}});
  };
  const double now_s = clock_monotonic_s();
  const bool ended = ordered_ && !heard().tracks && now_s - began_s_ > kBegins_s;  // by others
  if (!ordered_ || reverses || ended) {
    began_s_ = now_s;
    client_->choose("TELESCOPE_TRACK_STATE", "TRACK_OFF");
    client_->choose("TELESCOPE_TRACK_MODE", "TRACK_CUSTOM");
    order();
    client_->choose("TELESCOPE_TRACK_STATE", "TRACK_ON");
  }
  order();
  ordered_ = rate;
}

void IndiLink::go_to(const Equatorial& to) {
  ordered_.reset();
  client_->choose("ON_COORD_SET", "SLEW");
  client_->order("EQUATORIAL_EOD_COORD",
                 {{"RA", to.ra_rad / kHour_rad}, {"DEC", degrees(to.dec_rad)}});
}

}  // namespace ols::indi
