#include "export/factory.h"

#include <stdexcept>
#include <utility>

#include "export/asterix/asterix_encoder.h"
#include "export/files/courageous.h"
#include "export/files/document.h"
#include "export/files/geojson.h"
#include "export/files/gpx.h"
#include "export/files/kml.h"
#include "export/mqtt/mqtt_encoder.h"
#include "export/outlet/file_link.h"
#include "export/outlet/mqtt_link.h"
#include "export/outlet/queued_outlet.h"
#include "export/outlet/sapient_link.h"
#include "export/outlet/stream_link.h"
#include "export/outlet/udp_outlet.h"
#include "export/sapient/sapient_encoder.h"
#include "export/tak/cot_encoder.h"

namespace ols::exports {
namespace {

// So that a live file of hundreds of tracks stays at some megabytes.
constexpr std::int64_t kMostLivePoints = 30'000;
constexpr const char* kLive = "-live";

DocumentEncoder::Writer writer_of(Format format, const ExportConfig& config) {
  const double line_m = config.cot.line_m;
  switch (format) {
    case Format::kGeoJson:
      return [line_m](const Picture& picture) { return geojson(picture, line_m); };
    case Format::kKml:
      return [line_m](const Picture& picture) { return kml(picture, line_m); };
    case Format::kGpx:
      return gpx;
    case Format::kCourageous:
      return [site = config.site, settings = config.courageous](const Picture& picture) {
        return courageous(picture, site, settings);
      };
    default:
      throw std::invalid_argument(std::string("the format ") + to_string(format) +
                                  " makes no file");
  }
}

std::unique_ptr<Encoder> live_document(const OutputConfig& output, const ExportConfig& config) {
  const PictureLimits limits{60.0 * config.history_min, kMostLivePoints,
                             needs_geoid(output.format)};
  const auto writer = writer_of(output.format, config);
  if (output.format != Format::kKml) return std::make_unique<DocumentEncoder>(limits, writer);
  const std::string live = file_name(parse_address(output.to).path, kLive);
  const std::string link = kml_link(live.substr(live.rfind('/') + 1), 1.0 / output.gate.rate_hz);
  return std::make_unique<DocumentEncoder>(limits, writer, kLive, Packets{{"link", link}});
}

SapientSettings sapient_settings(const ExportConfig& config) {
  SapientSettings settings = config.sapient;
  settings.site = config.site;
  return settings;
}

std::unique_ptr<Encoder> make_encoder(const OutputConfig& output, const ExportConfig& config) {
  switch (output.format) {
    case Format::kCot:
      return std::make_unique<CotEncoder>(config.cot, std::nullopt);
    case Format::kCotProtobuf: {
      const bool is_mesh = parse_address(output.to).scheme == Scheme::kUdp;
      return std::make_unique<CotEncoder>(config.cot,
                                          is_mesh ? TakFraming::kMesh : TakFraming::kStream);
    }
    case Format::kMqtt:
      return std::make_unique<MqttEncoder>(config.mqtt, config.site);
    case Format::kAsterix:
      return std::make_unique<AsterixEncoder>(config.asterix);
    case Format::kSapient:
      return std::make_unique<SapientEncoder>(sapient_settings(config));
    default:
      return live_document(output, config);
  }
}

std::unique_ptr<Link> make_link(const Address& address, const OutputConfig& output,
                                const ExportConfig& config) {
  const TlsFiles files{output.ca, output.certificate, output.key};
  switch (address.scheme) {
    case Scheme::kMqtt:
    case Scheme::kMqtts: {
      const MqttLogin login{"ols-export-" + config.site + "-" + output.name, output.user,
                            output.password_file, status_topic(config.mqtt, config.site)};
      return std::make_unique<MqttLink>(address, files, login);
    }
    case Scheme::kFile:
      return std::make_unique<FileLink>(address.path);
    default:
      if (output.format == Format::kSapient) {
        return std::make_unique<SapientLink>(address, files, sapient_settings(config));
      }
      return std::make_unique<StreamLink>(address, files);
  }
}

}  // namespace

std::unique_ptr<Output> make_output(const OutputConfig& output, const ExportConfig& config) {
  const Address address = parse_address(output.to);
  std::unique_ptr<Outlet> outlet;
  if (address.scheme == Scheme::kUdp) {
    outlet = std::make_unique<UdpOutlet>(address);
  } else {
    outlet = std::make_unique<QueuedOutlet>(make_link(address, output, config));
  }
  const double period_s = address.scheme == Scheme::kFile ? 1.0 / output.gate.rate_hz : 1.0;
  return std::make_unique<Output>(output.name, output.gate, period_s, make_encoder(output, config),
                                  std::move(outlet));
}

std::unique_ptr<Encoder> make_file_encoder(Format format, const ExportConfig& config) {
  return std::make_unique<DocumentEncoder>(PictureLimits{.needs_sea = needs_geoid(format)},
                                           writer_of(format, config));
}

}  // namespace ols::exports
