// For the tests of ownership: two regions, each with an active and a standby fusion, and a target
// that crosses the border of the regions. The store of owners may answer late or never, either to
// all nodes or only to one.
#pragma once

#include <cmath>
#include <deque>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bridge/ownership/ownership.h"

namespace ols::bridge {

inline constexpr double kLatitude_deg = 49.5, kBorder_deg = 17.0;
inline constexpr double kMetresPerDegree = 72'216.0;  // of longitude, at kLatitude_deg
inline constexpr std::int64_t kStart_us = 1'700'000'000'000'000;

// Behaves like the key-value store of NATS: each write gets the next revision number, which counts
// the writes of all keys.
class Store {
 public:
  struct Kept {
    OwnerRecord record;
    std::uint64_t revision = 0;
  };
  StoreAnswer write(const StoreRequest& request, std::uint64_t& revision) {
    const auto at = records.find(request.target);
    const std::uint64_t is = at == records.end() ? 0 : at->second.revision;
    if (is != request.revision) return StoreAnswer::kRefused;
    revision = ++last;
    records[request.target] = {request.record, revision};
    return StoreAnswer::kDone;
  }

  bool is_down = false;
  std::uint64_t last = 0;
  std::map<std::string, Kept> records;
};

// A fusion with its bridge. It sees the target with its own error and with its own ids.
struct Node {
  Node(const std::string& node_name, const Cell& node_cell, std::uint64_t seed)
      : name(node_name), cell(node_cell), random(seed) {
    start();
  }
  void start() {
    ++starts;
    ownership = std::make_unique<Ownership>(
        OwnershipRules{name + ":" + std::to_string(starts), cell, 2000.0});
    track_id = static_cast<std::int64_t>(random() % 100'000 + 1);
    is_alive = true;
    heard_revision = 0;
  }

  std::string name;
  Cell cell;
  std::mt19937_64 random;
  std::unique_ptr<Ownership> ownership;
  std::int64_t track_id = 0;
  bool is_alive = true;
  bool is_deaf = false;  // it is not notified of changes in the store
  bool is_cut = false;   // it has no connection to the store
  int starts = 0;
  std::uint64_t heard_revision = 0;
  double offset_s = 0.0;  // of the node's monotonic clock
};

// A message that arrives later: an answer of the store, or its notification of a change.
struct Later {
  double due_s = 0.0;
  Node* node = nullptr;
  int start = 0;
  StoreRequest request;
  bool is_answer = false;
  StoreAnswer answer = StoreAnswer::kNone;
  std::uint64_t revision = 0;
};

class Border {
 public:
  explicit Border(std::uint64_t seed) : random_(seed) {
    const Cell west{49.0, 16.0, 50.0, kBorder_deg}, east{49.0, kBorder_deg, 50.0, 18.0};
    nodes.emplace_back("west-a", west, seed + 1);
    nodes.emplace_back("west-b", west, seed + 2);
    nodes.emplace_back("east-a", east, seed + 3);
    nodes.emplace_back("east-b", east, seed + 4);
    for (Node& node : nodes) node.offset_s = 100.0 * uniform();
  }

  double uniform() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }
  Now at(const Node& node) const {
    return {kStart_us + static_cast<std::int64_t>(now_s * 1e6), now_s + node.offset_s};
  }

  // Advances the time by 10 ms.
  void turn(double east_m, double speed_m_s);
  // The nodes that now publish the target as confirmed owners.
  std::vector<Node*> owners(std::vector<Grant>* grants = nullptr);
  // The nodes that now publish the target, confirmed or not.
  std::vector<Node*> publishers(std::vector<Grant>* grants = nullptr);
  // Connects a node to the store again; the node's client then reads all records.
  static void mend(Node& node) {
    node.is_cut = false;
    node.heard_revision = 0;
  }

  double now_s = 1.0;
  std::deque<Node> nodes;
  Store store;

 private:
  bool reaches_store(const Node& node) const { return !store.is_down && !node.is_cut; }
  void publish(double east_m, double speed_m_s);
  void see(Node& node, double east_m, double speed_m_s);
  void send(Node& node, const StoreRequest& request);
  void look_again(Node& node, const StoreRequest& request);
  void deliver();
  double delay_s() { return 0.001 + 0.01 * uniform(); }

  std::mt19937_64 random_;
  std::deque<Later> later_;
  long turns_ = 0;
};

inline void Border::see(Node& node, double east_m, double speed_m_s) {
  std::normal_distribution<double> error(0.0, 2.0);
  Track track;
  track.id = node.track_id;
  track.position_m = {east_m + error(node.random), error(node.random), error(node.random)};
  track.velocity_m_s = {speed_m_s, 0.0, 0.0};
  track.sd_m = 2.0;
  track.latitude_deg = kLatitude_deg;
  track.longitude_deg = kBorder_deg + east_m / kMetresPerDegree;
  node.ownership->hear(track, at(node));
}

inline void Border::send(Node& node, const StoreRequest& request) {
  std::uint64_t revision = 0;
  if (request.is_wish) {
    if (!reaches_store(node)) return;
    revision = ++store.last;
  } else {
    const StoreAnswer answer =
        reaches_store(node) ? store.write(request, revision) : StoreAnswer::kNone;
    const double late_s = answer == StoreAnswer::kNone ? 1.0 : delay_s();
    later_.push_back({now_s + late_s, &node, node.starts, request, true, answer, revision});
    if (answer != StoreAnswer::kDone) return;
  }
  for (Node& other : nodes) {
    later_.push_back(
        {now_s + delay_s(), &other, other.starts, request, false, StoreAnswer::kDone, revision});
  }
}

// After a refusal, the store's client reads the record again.
inline void Border::look_again(Node& node, const StoreRequest& request) {
  if (const auto kept = store.records.find(request.target); kept != store.records.end()) {
    node.ownership->learn(request.target, kept->second.record, kept->second.revision, at(node));
  } else {
    node.ownership->learn_gone(request.target, at(node));
  }
}

inline void Border::deliver() {
  for (std::size_t i = 0; i < later_.size();) {
    if (later_[i].due_s > now_s) {
      ++i;
      continue;
    }
    const Later one = later_[i];
    later_.erase(later_.begin() + static_cast<std::ptrdiff_t>(i));
    if (!one.node->is_alive || one.node->starts != one.start) continue;
    Ownership& ownership = *one.node->ownership;
    const Now now = at(*one.node);
    const StoreRequest& request = one.request;
    if (one.is_answer) {
      if (one.answer == StoreAnswer::kRefused) look_again(*one.node, request);
      ownership.answer(request, one.answer, one.revision, now);
    } else if (one.node->is_deaf || one.node->is_cut) {
      continue;
    } else if (request.is_wish) {
      ownership.learn_wish(request.target, request.record.owner, one.revision, now);
    } else {
      ownership.learn(request.target, request.record, one.revision, now);
    }
  }
}

inline void Border::turn(double east_m, double speed_m_s) {
  now_s += 0.01;
  ++turns_;
  deliver();
  for (Node& node : nodes) {
    if (!node.is_alive) continue;
    // A new process reads all records.
    if (node.heard_revision == 0 && reaches_store(node)) {
      node.heard_revision = 1;
      for (const auto& [target, kept] : store.records) {
        node.ownership->learn(target, kept.record, kept.revision, at(node));
      }
    }
    if (turns_ % 20 == 0) node.ownership->feel_store(reaches_store(node), at(node));
    if (turns_ % 6 == 0) see(node, east_m, speed_m_s);
    if (turns_ % 5 != 0) continue;
    for (const StoreRequest& request : node.ownership->step(at(node))) send(node, request);
  }
  if (turns_ % 6 == 0) publish(east_m, speed_m_s);
}

// All other nodes receive what an owner publishes.
inline void Border::publish(double east_m, double speed_m_s) {
  std::vector<Grant> grants;
  const auto who = publishers(&grants);
  for (std::size_t i = 0; i < who.size(); ++i) {
    const TargetReport said{grants[i].id, {east_m, 0, 0}, {speed_m_s, 0, 0}, 2.0, grants[i].epoch};
    for (Node& other : nodes) {
      if (&other != who[i] && other.is_alive) other.ownership->hear(said, at(other));
    }
  }
}

inline std::vector<Node*> Border::publishers(std::vector<Grant>* grants) {
  std::vector<Node*> who;
  for (Node& node : nodes) {
    if (!node.is_alive) continue;
    const auto grant = node.ownership->grant(node.track_id, at(node));
    if (!grant) continue;
    who.push_back(&node);
    if (grants != nullptr) grants->push_back(*grant);
  }
  return who;
}

inline std::vector<Node*> Border::owners(std::vector<Grant>* grants) {
  std::vector<Grant> all;
  std::vector<Node*> who;
  const auto publishing = publishers(&all);
  for (std::size_t i = 0; i < publishing.size(); ++i) {
    if (!all[i].is_confirmed) continue;
    who.push_back(publishing[i]);
    if (grants != nullptr) grants->push_back(all[i]);
  }
  return who;
}

}  // namespace ols::bridge
