// reed_export_settings SCENARIO [SECTION.KEY=VALUE …]: the controller's settings and its planned path as C++ arrays on
// standard output, for a target without files.
#include <cstdio>

#include "reed/config/controller/load_controller_config.h"
#include "reed/embedded/settings_image.h"
#include "reed/firmware/controller/for_joints.h"
#include "reed/rt/program.h"

REED_SET_UP_FOR(extern, 5)

namespace reed::embedded {
namespace {

static_assert(N == 5 && P == kLoopParameters<N>);

void Print(double value) {
  std::printf("%.17g,\n", value > 1e300 ? 1e300 : (value < -1e300 ? -1e300 : value));
}

void Export(const ControllerConfig& scenario) {
  Settings<N, P> settings = SettingsFrom<N, P>(scenario, true);
  std::printf("const double kSettings[] = {\n");
  VisitSettings([](double& value) { Print(value); }, settings);
  std::printf("};\n");
  const reference::PlannedPath<N> path = PathFrom(scenario, settings.arm);
  std::printf(
      "const double kSpacing_s = %.17g;\nconst std::size_t kNumKnots = %zu;\nconst double kKnots[] = {\n",
      path.spacing_s, path.knots.size());
  for (const auto& knot : path.knots)
    for (const auto* part : {&knot.q, &knot.q_dot, &knot.q_ddot})
      for (const double value : *part) Print(value);
  std::printf("};\n");
}

}  // namespace
}  // namespace reed::embedded

int main(int argc, char** argv) {
  return reed::rt::RunProgram("reed_export_settings", [&] {
    reed::LoadOptions options;
    options.set.assign(argv + 2, argv + (argc > 2 ? argc : 2));
    reed::embedded::Export(reed::LoadControllerConfig(argc > 1 ? argv[1] : "press_known", options));
    return 0;
  });
}
