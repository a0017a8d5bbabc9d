// A device for which there are several kinds. The key `kind` in its configuration section chooses
// one. Pure.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "base/config/config_section.h"

namespace ols::device {

// A row in the table of a device's kinds. `Kind` is the common interface of these kinds. Its
// function `section()` binds the configuration keys to the object.
template <class Kind>
struct KindRow {
  const char* name;      // the value of the key `kind`
  const char* sentence;  // description of the kind in one sentence
  std::shared_ptr<Kind> (*make)();
};

template <class Made, class Kind>
std::shared_ptr<Kind> make_kind() {
  return std::make_shared<Made>();
}

// Copies share the kinds' objects, and thus the values that were read into them.
template <class Kind>
class ChosenKind {
 public:
  // Chooses the first kind of the table, with its default values.
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

  // The device's configuration section. When a configuration is read into it, the key `kind`
  // chooses the kind.
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
