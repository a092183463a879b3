// The mps2-an500 board (Cortex-M7) as qemu emulates it: vector table, start, semihosting, SysTick as a
// counter of instructions. With -icount shift=0 an instruction takes 1 ns of the emulated time and SysTick,
// 25 MHz, counts 40 of them.
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "reed/embedded/platform.h"

extern "C" {
extern std::uint32_t stack_bottom, stack_top, data_load, data_start, data_end, bss_start, bss_end;
int main();
[[noreturn]] void ResetHandler();
[[noreturn]] void FaultHandler();
}

namespace {

volatile std::uint32_t& Register(std::uintptr_t address) {
  return *reinterpret_cast<volatile std::uint32_t*>(address);
}
constexpr std::uintptr_t kSysTickControl = 0xE000E010, kSysTickReload = 0xE000E014,
                         kSysTickValue = 0xE000E018;
constexpr std::uintptr_t kCoprocessors = 0xE000ED88;
constexpr std::uint32_t kPaint = 0xA5A5A5A5, kSysTickMask = 0x00FFFFFF, kInstructionsPerTick = 40;

int Semihost(int operation, const void* argument) {
  register int r0 asm("r0") = operation;
  register const void* r1 asm("r1") = argument;
  asm volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
  return r0;
}
constexpr int kWrite0 = 4, kExitExtended = 0x20;
constexpr std::uint32_t kApplicationExit = 0x20026;

void Exit(std::uint32_t status) {
  const std::uint32_t block[2] = {kApplicationExit, status};
  Semihost(kExitExtended, block);
}

struct VectorTable {
  std::uint32_t* stack;
  void (*handler[15])();
};
[[gnu::section(".vectors"), gnu::used]] const VectorTable kVectors{
    &stack_top,
    {ResetHandler, FaultHandler, FaultHandler, FaultHandler, FaultHandler, FaultHandler, nullptr, nullptr,
     nullptr, nullptr, FaultHandler, FaultHandler, nullptr, FaultHandler, FaultHandler}};

}  // namespace

void ResetHandler() {
  Register(kCoprocessors) = Register(kCoprocessors) | (0xFu << 20);  // the FPU, before the first double
  asm volatile("dsb\nisb");
  const std::uint32_t* from = &data_load;
  for (std::uint32_t* to = &data_start; to < &data_end; ++to) *to = *from++;
  for (std::uint32_t* to = &bss_start; to < &bss_end; ++to) *to = 0;
  for (std::uint32_t* word = &stack_bottom;
       word < static_cast<std::uint32_t*>(__builtin_frame_address(0)) - 64; ++word)
    *word = kPaint;
  Register(kSysTickReload) = kSysTickMask;
  Register(kSysTickValue) = 0;
  Register(kSysTickControl) = 5;  // on, processor clock, no interrupt
  main();
  while (true) Exit(0);
}

void FaultHandler() {
  while (true) Exit(86);
}

namespace reed::embedded {

void Print(const char* text) noexcept { Semihost(kWrite0, text); }
std::uint32_t Instructions() noexcept {
  return (kSysTickMask - (Register(kSysTickValue) & kSysTickMask)) * kInstructionsPerTick;
}
std::uint32_t StackUsed() noexcept {
  const std::uint32_t* word = &stack_bottom;
  while (word < &stack_top && *word == kPaint) ++word;
  return static_cast<std::uint32_t>((&stack_top - word) * 4);
}
void End() noexcept { Exit(0); }

}  // namespace reed::embedded
