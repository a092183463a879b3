#include "reed/config/plant/load_plant_config.h"

#include "reed/config/schema/halves.h"
#include "reed/config/schema/scenario_file.h"

namespace reed {

PlantConfig LoadPlantConfig(const std::string& name_or_path, const LoadOptions& options) {
  return PlantHalf(LoadScenario(name_or_path, options, Wanted::kPlantHalf));
}

}  // namespace reed
