#pragma once
// Sessions by the dimension of their motion, one a file.

#include <memory>
#include <string>
#include <vector>

#include "experiments/session.h"
#include "motions/input_error.h"

namespace kds {

[[nodiscard]] InputError unsupported_degree(int degree);

[[nodiscard]] std::unique_ptr<Session> make_session_in_line(const Scene& scene,
                                                            const std::vector<std::string>& structures,
                                                            KernelName kernel, AuditMode audits);
[[nodiscard]] std::unique_ptr<Session> make_session_in_plane(const Scene& scene,
                                                             const std::vector<std::string>& structures,
                                                             KernelName kernel, AuditMode audits);
[[nodiscard]] std::unique_ptr<Session> make_session_in_space(const Scene& scene,
                                                             const std::vector<std::string>& structures,
                                                             KernelName kernel, AuditMode audits);

}  // namespace kds
