#include <cstdio>

#include "reed/embedded/platform.h"

namespace reed::embedded {

void Print(const char* text) noexcept { std::fputs(text, stdout); }
std::uint32_t Instructions() noexcept { return 0; }
std::uint32_t StackUsed() noexcept { return 0; }
void End() noexcept {}

}  // namespace reed::embedded
