#include "export/sapient/registration.h"

#include "export/sapient/frame.h"
#include "export/sapient/sapient_messages.h"
#include "export/text.h"
#include "sapient/sapient.pb.h"

namespace ols::exports {
namespace {

using sapient::Registration;

void set_seconds(Registration::Duration& duration, double seconds) {
  duration.set_units(Registration::TIME_UNITS_SECONDS);
  duration.set_value(static_cast<float>(seconds));
}

void set_geographic(Registration::LocationType& location) {
  location.set_location_units(sapient::LOCATION_COORDINATE_SYSTEM_LAT_LNG_DEG_M);
  location.set_location_datum(sapient::LOCATION_DATUM_WGS84_E);
}

void describe_node(Registration& registration, const SapientSettings& settings) {
  registration.set_icd_version("BSI Flex 335 v2.0");
  registration.set_name("Optical Localization System " + settings.site);
  registration.set_short_name("OLS " + settings.site);
  auto& node = *registration.add_node_definition();
  node.set_node_type(Registration::NODE_TYPE_FUSION_NODE);
  node.add_node_sub_type("passive optical triangulation");
  auto& cameras = *registration.add_node_definition();
  cameras.set_node_type(Registration::NODE_TYPE_CAMERA);
  cameras.add_node_sub_type("pan-tilt");
  auto& capability = *registration.add_capabilities();
  capability.set_category("Fusion");
  capability.set_type("Position by triangulation of bearings");
  auto& product = *registration.add_config_data();
  product.set_manufacturer("OLS");
  product.set_model("Optical Localization System");
}

void describe_status(Registration& registration, double interval_s) {
  auto& status = *registration.mutable_status_definition();
  set_seconds(*status.mutable_status_interval(), interval_s);
  set_geographic(*status.mutable_location_definition());
  for (const char* type : {"Other", "InternalFault", "NotDetecting"}) {
    auto& field = *status.add_status_report();
    field.set_category(Registration::STATUS_REPORT_CATEGORY_STATUS);
    field.set_type(type);
    field.set_units("a station's name and state");
  }
}

void describe_detections(Registration::DetectionDefinition& detections) {
  set_geographic(*detections.mutable_location_type());
  const auto add_field = [&](const char* name, const char* units) {
    auto& field = *detections.add_detection_report();
    field.set_category(Registration::DETECTION_REPORT_CATEGORY_TRACK);
    field.set_type(std::string(kSapientOwn) + name);
    field.set_units(units);
  };
  add_field("state", "tentative, confirmed, coasted, ended");
  add_field("stations", "names of those that see it");
  add_field("covariance_enu_m2", "m2: ee en eu nn nu uu");
  add_field("velocity_covariance_enu_m2_s2", "m2/s2: ee en eu nn nu uu");
  auto& classes = *detections.add_detection_class_definition();
  for (const auto& one : wire::kObjectClasses) {
    classes.add_class_definition()->set_type(standard_class(one.object_class));
  }
  auto& velocity = *detections.mutable_velocity_type();
  velocity.mutable_enu_velocity_units()->set_east_north_rate_units(sapient::SPEED_UNITS_MS);
  velocity.mutable_enu_velocity_units()->set_up_rate_units(sapient::SPEED_UNITS_MS);
  velocity.set_location_datum(sapient::LOCATION_DATUM_WGS84_E);
  auto& errors = *detections.mutable_geometric_error();
  errors.set_type("Standard Deviation");
  errors.set_units("as the location: degrees, degrees, metres");
  errors.set_variation_type("Reported");
}

// One mode, in which no task is taken; the standard wants a region for tasks all the same.
void describe_mode(Registration& registration) {
  auto& mode = *registration.add_mode_definition();
  mode.set_mode_name("Default");
  mode.set_mode_type(Registration::MODE_TYPE_PERMANENT);
  mode.set_mode_description("Follows what its operators designate; takes no tasks");
  set_seconds(*mode.mutable_settle_time(), 0.0);
  mode.set_scan_type(Registration::SCAN_TYPE_STEERABLE);
  mode.set_tracking_type(Registration::TRACKING_TYPE_TRACKLET);
  describe_detections(*mode.add_detection_definition());
  auto& task = *mode.mutable_task();
  task.set_concurrent_tasks(0);
  auto& region = *task.mutable_region_definition();
  region.add_region_type(Registration::REGION_TYPE_AREA_OF_INTEREST);
  set_geographic(*region.add_region_area());
}

}  // namespace

std::string sapient_registration(const SapientSettings& settings, std::int64_t utime_us) {
  sapient::SapientMessage message = message_of(settings, utime_us);
  Registration& registration = *message.mutable_registration();
  describe_node(registration, settings);
  describe_status(registration, settings.status_s);
  describe_mode(registration);
  return framed(message.SerializeAsString());
}

}  // namespace ols::exports
