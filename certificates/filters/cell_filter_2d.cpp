#include "certificates/filters/define_cell_filter.h"

namespace kds {

template std::unique_ptr<CellFilter<2>> cell_filter_over(const MotionRef<2>&, FilterOf);
template std::unique_ptr<CellFilter<2>> cell_filter_for_any_processor(const MotionRef<2>&);

}  // namespace kds
