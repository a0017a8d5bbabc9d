// Decides which of several fusions that see the same target owns it. The owner publishes the target
// and slews stations to it. All fusions track the target, whoever owns it. Pure: the store's
// contents come in, requests to the store go out.
//
// An owner renews its record by compare-and-set. A fusion that takes over the target does the same,
// so only one of the two succeeds. An owner counts its lease from before it sent the renewal, and
// makes it slightly shorter. Another fusion counts the lease from when it received the renewal. So
// two fusions never own one target at the same instant, whatever their clocks show.
//
// While the store does not answer, an owner continues, and marks each message as unconfirmed. If
// the store answers nobody, no fusion can take the target. If only this owner is cut off, another
// fusion takes the target, and both publish. The old owner stops when it receives a message of the
// new one, which has the greater epoch.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bridge/ownership/cell.h"
#include "bridge/ownership/owner_record.h"
#include "bridge/passage.h"

namespace ols::bridge {

struct OwnershipRules {
  std::string name;  // name and start of this fusion; never used again
  Cell cell_deg{-90.0, -180.0, 90.0, 180.0};
  double margin_m = 2000.0;  // how far beyond the border a target must be, plus 3 sigma, before it
                             // changes owner
};

// A target of this fusion, as just published.
struct Track {
  std::int64_t id = 0;  // this fusion's number for it
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// A target as just published by another owner.
struct TargetReport {
  std::string target;  // region-wide id
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  std::uint64_t epoch = 0;
};

// A request to the store: write this record if the stored revision is still `revision` (0: there is
// no record). With `is_wish`: tell the owner that this fusion wants the target.
struct StoreRequest {
  std::string target;
  OwnerRecord record;
  std::uint64_t revision = 0;
  bool is_wish = false;
};

enum class StoreAnswer { kDone, kRefused, kNone };

class Ownership {
 public:
  explicit Ownership(OwnershipRules rules) : rules_(std::move(rules)) {}

  void hear(const Track& track, const Now& now);
  void hear(const TargetReport& sighting, const Now& now);
  // The store now has this record of a target.
  void learn(const std::string& target, const OwnerRecord& record, std::uint64_t revision,
             const Now& now);
  // The store has no record of the target any more.
  void learn_gone(const std::string& target, const Now& now);
  // `by` wants to own the target. A store may repeat an old wish; its revision shows that it is
  // old.
  void learn_wish(const std::string& target, const std::string& by, std::uint64_t revision,
                  const Now& now);
  // The store's answer to a request of step(); wishes are not answered. After a refusal, learn()
  // has already been called with the store's actual record, or that record is still unknown.
  void answer(const StoreRequest& request, StoreAnswer answer, std::uint64_t revision,
              const Now& now);

  // Whether the store answers now. An owner is not blamed for renewals that an outage has
  // prevented.
  void feel_store(bool answers, const Now& now);

  // The requests that are due now. Call some 20 times a second.
  std::vector<StoreRequest> step(const Now& now);

  // The grant under which this fusion publishes its target now; nullopt: another one does. A search
  // (id 0) has no owner.
  std::optional<Grant> grant(std::int64_t track_id, const Now& now) const;

  struct Counts {
    std::size_t owned = 0, others = 0;
    std::uint64_t taken = 0, handed_over = 0, lost = 0;
    std::uint64_t epoch = 0;   // the greatest among owned targets
    bool is_confirmed = true;  // for all owned targets
  };
  Counts counts(const Now& now) const;

 private:
  enum class Asked { kNothing, kRenewal, kTaking, kRelease };
  struct Request {  // the current request
    Asked what = Asked::kNothing;
    OwnerRecord record;
    double asked_s = 0.0;
  };
  // A target in the store, and this fusion's relation to it.
  struct Entry {
    OwnerRecord record;
    std::uint64_t revision = 0;
    // Wishes up to old_revision are old. next_old_revision replaces it from time to time.
    std::uint64_t old_revision = 0, next_old_revision = 0;
    double marked_s = -1e9;
    double changed_s = 0.0;  // when this fusion received the record
    TargetReport place;
    double seen_s = -1e9;  // when the target was at `place`
    std::string wished_by;
    double wished_s = -1e9;
    double due_s = 0.0;  // when the next request is due
    double wish_due_s = 0.0;
    Request request;
    bool is_mine = false;
    bool is_doubted = false;      // another fusion has taken it, as far as known
    std::uint64_t epoch = 0;      // if owned
    double held_until_s = -1e9;   // if owned: its lease
    double doubled_since_s = -1;  // if owned: since when another fusion has a record of the same
                                  // target; negative: there is no such record
  };
  struct Seen {
    Track track;
    double seen_s = 0.0, first_s = 0.0;
    std::string target;  // its entry; empty: none yet
  };
  using Requests = std::vector<StoreRequest>;

  void bind(const Now& now);
  std::string nearest(const Seen& seen, const Now& now) const;
  bool is_bound(const std::string& target, double now_s) const;
  void make(Seen& seen, const Now& now, Requests& requests);
  void own(Entry& entry, const Seen& seen, const Now& now, Requests& requests);
  void stand_by(Entry& entry, const Seen& seen, const Now& now, Requests& requests);
  bool may_take(const Entry& entry, double depth_m, double now_s) const;
  bool is_double(Entry& entry, const Seen& seen, const Now& now) const;
  void let_go(const Now& now, Requests& requests);
  void ask(Entry& entry, Asked what, OwnerRecord record, double now_s, Requests& requests);
  void settle(Entry& entry, std::uint64_t revision);
  static void keep(Entry& entry, const OwnerRecord& record, std::uint64_t revision, const Now& now);
  OwnerRecord record_of(const Seen& seen, const Now& now);
  double delay_s() const;

  const OwnershipRules rules_;
  std::map<std::string, Entry> entries_;  // by region-wide id
  std::map<std::int64_t, Seen> tracks_;   // by the fusion's own id
  std::int64_t beat_ = 0, made_ = 0;
  bool answers_ = false;
  Counts counts_;
};

}  // namespace ols::bridge
