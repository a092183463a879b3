// reed_export_arm NAME|FILE: the five-joint arm as a C++ array on standard output, for the embedded core.
#include <cstdio>
#include <exception>

#include "reed/config/schema/arm_file.h"
#include "reed/config/schema/halves.h"
#include "reed/embedded/arm_image.h"
#include "reed/embedded/core.h"

int main(int argc, char** argv) {
  try {
    reed::embedded::Arm arm(reed::NominalOf(reed::LoadArm(argc > 1 ? argv[1] : "a5")));
    std::printf("inline constexpr double kArmImage[] = {\n");
    reed::embedded::VisitNumbers([](double value) { std::printf("%.17g,\n", value > 1e300 ? 1e300 : value); },
                                 arm);
    std::printf("};\n");
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reed_export_arm: %s\n", error.what());
    return 2;
  }
}
