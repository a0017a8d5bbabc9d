// Decides which fusion owns a target that several fusions track. All of them go on tracking it, but
// only the owner publishes the target and slews stations to it. Pure: the store's contents come in,
// requests to the store go out.
//
// An owner renews its record by compare-and-set. A fusion that takes over the target does the same;
// therefore only one of the two succeeds. The owner counts its lease from the moment before it
// sends a renewal, and lets the lease end early. Any other fusion counts the lease from the moment
// when it receives the renewal. Two fusions therefore never hold the lease of one target at the
// same instant, whatever their clocks show.
//
// While the store does not answer, an owner goes on without a lease, and marks each message as
// unconfirmed. If the store answers nobody, no other fusion can take the target. If only the owner
// is cut off from the store, another fusion takes the target, and both publish it. The old owner
// stops when it receives a message of the new owner, which has the greater epoch.
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
  std::string name;  // this fusion's name and a number drawn at its start; a later start has
                     // another one
  Cell cell_deg{-90.0, -180.0, 90.0, 180.0};
  double margin_m = 2000.0;  // this fusion asks for another owner's target if the target is inside
                             // cell_deg by more than this, and by more than 3 sigma
};

// A target of this fusion, as it has just published it.
struct Track {
  std::int64_t id = 0;  // this fusion's number for the target
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// A target as another owner has just published it.
struct TargetReport {
  std::string target;  // the target's id, the same for all fusions
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  std::uint64_t epoch = 0;
};

// A request to the store: write this record, if the revision in the store is still `revision` (0:
// the store has no record). If `is_wish`: tell the owner that this fusion wants the target.
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
  // Call when the store reports its new record of a target.
  void learn(const std::string& target, const OwnerRecord& record, std::uint64_t revision,
             const Now& now);
  // Call when the store reports that it has no record of the target any more.
  void learn_gone(const std::string& target, const Now& now);
  // Call when the store reports that the fusion `by` wants to own the target. A store may repeat an
  // old wish, which is recognised by its revision.
  void learn_wish(const std::string& target, const std::string& by, std::uint64_t revision,
                  const Now& now);
  // Takes the store's answer to a request of step(); wishes have no answer. Before answer() reports
  // a refusal, learn() has been called with the record in the store, if that record could be read.
  void answer(const StoreRequest& request, StoreAnswer answer, std::uint64_t revision,
              const Now& now);

  // Tells whether the store answers now. After an outage of the store, every lease counts from the
  // end of the outage, because nobody could renew a lease during the outage.
  void feel_store(bool answers, const Now& now);

  // Returns the requests that are due now. Call about 20 times a second.
  std::vector<StoreRequest> step(const Now& now);

  // The id and epoch under which this fusion publishes its target now; nullopt: it must not publish
  // the target. `track_id`: not 0, because a search (id 0) has no owner.
  std::optional<Grant> grant(std::int64_t track_id, const Now& now) const;

  struct Counts {
    std::size_t owned = 0, others = 0;
    std::uint64_t taken = 0, handed_over = 0, lost = 0;
    std::uint64_t epoch = 0;   // the greatest epoch of an owned target
    bool is_confirmed = true;  // the store answers, and the leases of all owned targets hold
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
    // Wishes with a revision up to old_revision are ignored. next_old_revision will replace it.
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
    bool is_doubted = false;      // another fusion seems to have taken it; the store's next answer
                                  // decides
    std::uint64_t epoch = 0;      // if owned
    double held_until_s = -1e9;   // if owned: end of the lease
    double doubled_since_s = -1;  // if owned: since when another fusion has a record of the same
                                  // target, too; negative: it has none
  };
  struct Seen {
    Track track;
    double seen_s = 0.0, first_s = 0.0;
    std::string target;  // key of its entry; empty: none yet
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
  std::map<std::string, Entry> entries_;  // by the id that is the same for all fusions
  std::map<std::int64_t, Seen> tracks_;   // by this fusion's own number
  std::int64_t beat_ = 0, made_ = 0;
  bool answers_ = false;
  Counts counts_;
};

}  // namespace ols::bridge
