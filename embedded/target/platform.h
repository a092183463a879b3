// What the runner of the reference cases needs of the machine below it; one implementation per machine.
#pragma once

#include <cstdint>

namespace reed::embedded {

void Print(const char* text) noexcept;
/// Instructions so far, to the resolution of the machine's timer; 0 where nobody counts.
std::uint32_t Instructions() noexcept;
/// Deepest stack so far, bytes; 0 where nobody knows.
std::uint32_t StackUsed() noexcept;
void End() noexcept;

}  // namespace reed::embedded
