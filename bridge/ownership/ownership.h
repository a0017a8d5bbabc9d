// Which of several fusions that see the same targets owns each of them, and so publishes it and
// slews stations to it. All run the tracks; only the publisher changes. Pure: what the store of
// owners says comes in, what to write there goes out.
//
// An owner renews its record by compare-and-set; so does a fusion that takes the target, and one of
// the two fails. An owner counts its lease from before its renewal was sent, and a little short;
// another fusion counts it from after it was heard. So two never own one target at one instant,
// whatever their clocks say. While the store does not answer it, an owner goes on, and says with
// each message that it is not confirmed. If it answers nobody, no fusion can take the target. But
// if this owner alone is cut from it, another fusion takes the target, and both publish until the
// old owner hears the new one, which has the greater epoch: then it stops.
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
  std::string name;  // of this fusion and its start: no other has it, ever
  Cell cell_deg{-90.0, -180.0, 90.0, 180.0};
  double margin_m = 2000.0;  // beyond the border, and 3 sigma, before a target changes
};

// A target of this fusion, as it has just published it.
struct Track {
  std::int64_t id = 0;  // the fusion's own
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  double latitude_deg = 0.0, longitude_deg = 0.0;
};

// What another owner has just published of a target.
struct Sighting {
  std::string target;  // region-wide id
  Vector position_m{}, velocity_m_s{};
  double sd_m = 0.0;
  std::uint64_t epoch = 0;
};

// To the store: this record, if the revision there is still this one (0: if there is none). Or,
// with `is_wish`, a word to the owner that this fusion is to have the target.
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
  void hear(const Sighting& sighting, const Now& now);
  // The store has this of a target now.
  void learn(const std::string& target, const OwnerRecord& record, std::uint64_t revision,
             const Now& now);
  // The store has nothing of it any more.
  void learn_gone(const std::string& target, const Now& now);
  // `by` wishes to own it. A store may say again what was wished long ago: its revision tells.
  void learn_wish(const std::string& target, const std::string& by, std::uint64_t revision,
                  const Now& now);
  // To a request of step(); wishes are not answered. Where it was refused, what the store has
  // instead is learnt before, or is not known yet.
  void answer(const StoreRequest& request, StoreAnswer answer, std::uint64_t revision,
              const Now& now);

  // Whether the store answers. One that returns has missed renewals: no owner is replaced for that.
  void feel_store(bool answers, const Now& now);

  // What is to be asked of the store now; call some 20 times a second.
  std::vector<StoreRequest> step(const Now& now);

  // Whether this fusion publishes its target now. Its search for one (id 0) is nobody's.
  std::optional<Grant> grant(std::int64_t track_id, const Now& now) const;

  struct Counts {
    std::size_t owned = 0, others = 0;
    std::uint64_t taken = 0, handed_over = 0, lost = 0;
    std::uint64_t epoch = 0;   // the greatest of what is owned
    bool is_confirmed = true;  // of all that is owned
  };
  Counts counts(const Now& now) const;

 private:
  enum class Asked { kNothing, kRenewal, kTaking, kRelease };
  struct Request {  // that is under way
    Asked what = Asked::kNothing;
    OwnerRecord record;
    double asked_s = 0.0;
  };
  // A target as the store has it, and what this fusion has to do with it.
  struct Entry {
    OwnerRecord record;
    std::uint64_t revision = 0;
    // Wishes up to the first revision are old; the second one takes its place from time to time.
    std::uint64_t old_revision = 0, next_old_revision = 0;
    double marked_s = -1e9;
    double changed_s = 0.0;  // its record, as heard here
    Sighting place;
    double seen_s = -1e9;  // there
    std::string wished_by;
    double wished_s = -1e9;
    double due_s = 0.0;  // the next request
    double wish_due_s = 0.0;
    Request request;
    bool is_mine = false;
    bool is_doubted = false;      // another one has taken it, by all that is known
    std::uint64_t epoch = 0;      // of an owner
    double held_until_s = -1e9;   // of an owner: its lease
    double doubled_since_s = -1;  // of an owner: another's record of the same target; < 0: none
  };
  struct Seen {
    Track track;
    double seen_s = 0.0, first_s = 0.0;
    std::string target;  // its entry's; empty: none yet
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
  std::map<std::int64_t, Seen> tracks_;   // by the fusion's own
  std::int64_t beat_ = 0, made_ = 0;
  bool answers_ = false;
  Counts counts_;
};

}  // namespace ols::bridge
