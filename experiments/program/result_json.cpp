#include "experiments/program/result_json.h"

#include "experiments/program/provenance.h"

namespace kds {

void add_provenance(Json& json) {
  json["version"] = program_version();
  const Machine machine = this_machine();
  json["machine"] = {
      {"cpu", machine.cpu}, {"cores", machine.cores}, {"os", machine.os}, {"compiler", machine.compiler}};
}

std::string text_of(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace kds
