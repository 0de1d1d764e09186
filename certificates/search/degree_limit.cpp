#include "certificates/search/degree_limit.h"

#include <stdexcept>
#include <string>

namespace kds::detail {

void require_searchable(std::string_view name, int degree_of_function, int degree_of_motion) {
  if (degree_of_function <= most_degree_of_function) return;
  throw std::invalid_argument(std::string(name) + " over motion of degree " +
                              std::to_string(degree_of_motion) + ": its function has degree " +
                              std::to_string(degree_of_function) + ", expected at most " +
                              std::to_string(most_degree_of_function));
}

}  // namespace kds::detail
