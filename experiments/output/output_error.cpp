#include "experiments/output/output_error.h"

#include <cerrno>
#include <system_error>

#include "motions/base/input_error.h"

namespace kds {

void fail_to_write(const std::string& subject, int error) {
  const std::string message =
      subject + ": " + (error == 0 ? "output failed" : std::generic_category().message(error));
  switch (error) {
    case EACCES:
    case EEXIST:
    case EISDIR:
    case ELOOP:
    case ENAMETOOLONG:
    case ENOENT:
    case ENOTDIR:
    case EPERM:
    case EROFS:
      throw InputError(message);
    default:
      throw OutputError(message);
  }
}

}  // namespace kds
