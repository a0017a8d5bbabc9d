#include "export/output.h"

#include <utility>

namespace ols::exports {

Output::Output(std::string name, const GateConfig& gate, double period_s,
               std::unique_ptr<Encoder> encoder, std::unique_ptr<Outlet> outlet)
    : name_(std::move(name)),
      gate_(gate),
      period_s_(period_s),
      encoder_(std::move(encoder)),
      outlet_(std::move(outlet)) {}

void Output::put(Packets packets) {
  if (!packets.empty()) outlet_->put(std::move(packets));
}

void Output::take(const Target& target) {
  if (const auto told = gate_.pass(target)) put(encoder_->encode(*told));
}

void Output::take(const Station& station) {
  if (gate_.passes(station)) put(encoder_->encode(station));
}

void Output::take(const Line& line) {
  if (gate_.passes(line)) put(encoder_->encode(line));
}

void Output::take(const Incident& incident) {
  if (gate_.passes(incident)) put(encoder_->encode_incident(incident));
}

void Output::step(double now_s, std::int64_t utime_us) {
  if (const std::uint64_t openings = outlet_->report().openings; openings != openings_) {
    openings_ = openings;
    encoder_->begin_again();
    due_s_ = now_s;
  }
  if (now_s < due_s_) return;
  due_s_ = now_s + period_s_;
  put(encoder_->due(utime_us));
}

}  // namespace ols::exports
