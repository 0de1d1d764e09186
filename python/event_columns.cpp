#include "python/event_columns.h"

#include <limits>
#include <span>

#include "python/arrays.h"

namespace kds::python {

void EventColumns::on_event(const Event& event) {
  if (!keeps_) return;
  frames_.push_back(event.frame());
  times_.push_back(event.picoseconds().value_or(std::numeric_limits<double>::quiet_NaN()));
  lower_.push_back(event.lower);
  upper_.push_back(event.upper);
  steps_.push_back(static_cast<std::int64_t>(event.step));
  structures_.push_back(static_cast<std::uint8_t>(event.structure_index));
  kinds_.push_back(event.change.kind);
  sizes_.push_back(event.change.size);
  ids_.insert(ids_.end(), event.ids().begin(), event.ids().end());
}

pybind11::dict EventColumns::take() {
  const std::size_t events = sizes_.size();
  constexpr std::size_t width = std::tuple_size_v<decltype(Change::ids)>;
  std::vector<std::int32_t> beads(events * width, -1);
  std::size_t next = 0;
  for (std::size_t i = 0; i < events; ++i)
    for (std::size_t k = 0; k < sizes_[i]; ++k)
      beads[i * width + k] = static_cast<std::int32_t>(ids_[next++]);
  pybind11::dict columns;
  columns["frame"] = array_of(std::exchange(frames_, {}));
  columns["time"] = array_of(std::exchange(times_, {}));
  columns["lower"] = array_of(std::exchange(lower_, {}));
  columns["upper"] = array_of(std::exchange(upper_, {}));
  columns["step"] = array_of(std::exchange(steps_, {}));
  columns["structure"] = array_of(std::exchange(structures_, {}));
  columns["kind"] = array_of(std::exchange(kinds_, {}));
  columns["beads"] = array_of(
      std::move(beads), {static_cast<pybind11::ssize_t>(events), static_cast<pybind11::ssize_t>(width)});
  sizes_.clear();
  ids_.clear();
  return columns;
}

}  // namespace kds::python
