// Runs the reference cases and prints every number of every result as its 64 bits, one line per case; then
// how many instructions a step took and how deep the stack was, where the platform knows. Host and target
// alike.
#include <cstdint>
#include <cstring>

#include "embedded_data.h"
#include "reed/embedded/arm_image.h"
#include "reed/embedded/core.h"
#include "reed/embedded/platform.h"

namespace reed::embedded {
namespace {

void PrintHex(std::uint64_t bits) {
  char text[18];
  for (int i = 0; i < 16; ++i) text[i] = "0123456789abcdef"[(bits >> (60 - 4 * i)) & 0xF];
  text[16] = ' ';
  text[17] = '\0';
  Print(text);
}

void Number(const char* name, std::uint32_t value) {
  Print(name);
  Print(" ");
  PrintHex(value);
  Print("\n");
}

void Run() {
  static Arm arm;
  const double* next = kArmImage;
  VisitNumbers([&](double& value) { value = *next++; }, arm);
  static Core core(arm);
  static Result result;
  std::uint32_t instructions = 0;
  for (const Case& one : kCases) {
    const std::uint32_t before = Instructions();
    core.Step(one, result);
    const std::uint32_t took = Instructions() - before;
    instructions = took > instructions ? took : instructions;
    double numbers[sizeof(Result) / sizeof(double)];
    std::memcpy(numbers, &result, sizeof numbers);
    for (const double number : numbers) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &number, sizeof bits);
      PrintHex(bits);
    }
    Print("\n");
  }
  Number("instructions", instructions);
  Number("stack", StackUsed());
}

}  // namespace
}  // namespace reed::embedded

int main() {
  reed::embedded::Run();
  reed::embedded::End();
}
