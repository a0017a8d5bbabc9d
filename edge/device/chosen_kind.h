// A device for which there are several kinds. The key `kind` in its configuration section chooses
// one. Pure.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"

namespace ols::device {

// A row in the table of a device's kinds. `Kind` has what all kinds have in common, and a function
// `section()` that binds the keys of a kind to itself.
template <class Kind>
struct KindRow {
  const char* name;      // the value of the key `kind`
  const char* sentence;  // what the kind is
  std::shared_ptr<Kind> (*make)();
};

template <class Made, class Kind>
std::shared_ptr<Kind> make_kind() {
  return std::make_shared<Made>();
}

// Copies share the values that were read.
template <class Kind>
class ChosenKind {
 public:
  // Initially the first kind is chosen, with its defaults.
  explicit ChosenKind(const std::vector<KindRow<Kind>>& table) {
    for (const KindRow<Kind>& row : table) kinds_.push_back({row, row.make()});
  }

  const char* name() const { return kinds_.at(chosen_).row.name; }
  Kind& operator*() const { return *kinds_.at(chosen_).kind; }
  Kind* operator->() const { return &**this; }
  // The chosen kind as `Made`; null if another kind is chosen.
  template <class Made>
  Made* as() const {
    return dynamic_cast<Made*>(&**this);
  }

  // The configuration section; reading it chooses the kind.
  config::Section section(std::string name, std::string sentence) {
    config::Section section{std::move(name), std::move(sentence)};
    section.choose = [this](std::size_t chosen) { chosen_ = chosen; };
    for (const Entry& entry : kinds_) {
      section.forms.push_back(entry.kind->section());
      section.forms.back().name = entry.row.name;
      section.forms.back().sentence = entry.row.sentence;
    }
    return section;
  }

 private:
  struct Entry {
    KindRow<Kind> row;
    std::shared_ptr<Kind> kind;
  };
  std::vector<Entry> kinds_;
  std::size_t chosen_ = 0;
};

}  // namespace ols::device
