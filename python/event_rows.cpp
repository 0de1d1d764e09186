#include "python/event_rows.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <new>
#include <span>
#include <string>
#include <string_view>

namespace kds::python {

namespace py = pybind11;

namespace {

struct Times {
  double frame, time, lower, upper;
  std::int64_t step;
};
using Beads = std::array<std::int32_t, std::tuple_size_v<decltype(Change::ids)>>;

/// Appends a name to a text that then has `size` characters.
void append_name(std::u32string& text, std::string_view name, std::size_t size) {
  text.append(name.begin(), name.end());
  text.resize(size, U'\0');
}

}  // namespace

void EventRows::set_structures(std::span<KineticStructure* const> structures) {
  structure_width_ = kind_width_ = 1;
  for (const KineticStructure* const structure : structures) {
    structure_width_ = std::max(structure_width_, structure->name().size());
    for (const EventKind& kind : structure->kinds()) kind_width_ = std::max(kind_width_, kind.name.size());
  }
  names_.clear();
  for (const KineticStructure* const structure : structures) {
    auto& of_kinds = names_.emplace_back();
    for (const EventKind& kind : structure->kinds()) {
      std::u32string& names = of_kinds.emplace_back();
      append_name(names, structure->name(), structure_width_);
      append_name(names, kind.name, structure_width_ + kind_width_);
    }
  }
  row_bytes_ = sizeof(Times) + (structure_width_ + kind_width_) * sizeof(char32_t) + sizeof(Beads);
}

void EventRows::on_event(const Event& event) {
  if (!keeps_) return;
  if (count_ == capacity_) {
    const std::size_t capacity = std::max<std::size_t>(64, 2 * capacity_);
    auto* const larger = static_cast<char*>(std::realloc(rows_.get(), capacity * row_bytes_));
    if (larger == nullptr) throw std::bad_alloc();
    static_cast<void>(rows_.release());
    rows_.reset(larger);
    capacity_ = capacity;
  }
  const Times times{event.frame(), event.picoseconds().value_or(std::numeric_limits<double>::quiet_NaN()),
                    event.lower, event.upper, static_cast<std::int64_t>(event.step)};
  const std::u32string& names = names_[event.structure_index][event.change.kind];
  Beads beads;
  beads.fill(-1);
  std::copy(event.ids().begin(), event.ids().end(), beads.begin());
  char* row = rows_.get() + count_ * row_bytes_;
  std::memcpy(row, &times, sizeof(Times));
  row += sizeof(Times);
  std::memcpy(row, names.data(), names.size() * sizeof(char32_t));
  row += names.size() * sizeof(char32_t);
  std::memcpy(row, beads.data(), sizeof(Beads));
  ++count_;
}

py::array EventRows::take() {
  py::list fields;
  for (const char* const name : {"frame", "time", "lower", "upper"})
    fields.append(py::make_tuple(name, "f8"));
  fields.append(py::make_tuple("step", "i8"));
  fields.append(py::make_tuple("structure", "U" + std::to_string(structure_width_)));
  fields.append(py::make_tuple("kind", "U" + std::to_string(kind_width_)));
  fields.append(py::make_tuple("beads", "i4", py::make_tuple(std::tuple_size_v<Beads>)));
  const py::dtype type = py::dtype::from_args(fields);
  const auto count = static_cast<py::ssize_t>(count_);
  if (count_ == 0) return py::array(type, std::vector<py::ssize_t>{0});
  char* bytes = rows_.release();
  if (void* const smaller = std::realloc(bytes, count_ * row_bytes_)) bytes = static_cast<char*>(smaller);
  count_ = capacity_ = 0;
  const py::capsule owner(bytes, [](void* memory) { std::free(memory); });
  return py::array(type, std::vector<py::ssize_t>{count}, bytes, owner);
}

}  // namespace kds::python
