#include "reed/config/controller/load_controller_config.h"

#include "reed/config/schema/halves.h"
#include "reed/config/schema/scenario_file.h"

namespace reed {

ControllerConfig LoadControllerConfig(const std::string& name_or_path, const LoadOptions& options) {
  return ControllerHalf(LoadScenario(name_or_path, options));
}

std::string TextOf(const ControllerConfig& config) { return ToToml(config); }

}  // namespace reed
