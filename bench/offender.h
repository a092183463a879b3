// Who broke a promise: the innermost function of one library on the stack. RT: for proofs only.
#pragma once

#include <cxxabi.h>
#include <dlfcn.h>
#include <execinfo.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace reed::bench {

using FunctionName = std::array<char, 200>;

/// Loads what backtrace() needs, so that the first real use allocates nothing.
inline void PrepareBacktraces() {
  std::array<void*, 4> frames{};
  backtrace(frames.data(), static_cast<int>(frames.size()));
}

/// The name of the innermost function whose library's path ends with `library`; "" if none. Allocates nothing.
inline void NameOffender(const char* library, FunctionName& out) noexcept {
  std::array<void*, 48> frames{};
  const int depth = backtrace(frames.data(), static_cast<int>(frames.size()));
  out[0] = '\0';
  for (int i = 0; i < depth; ++i) {
    Dl_info where{};
    if (dladdr(frames[static_cast<std::size_t>(i)], &where) == 0 || where.dli_fname == nullptr) continue;
    if (std::strcmp(where.dli_fname, library) != 0) continue;
    if (where.dli_sname != nullptr)
      std::snprintf(out.data(), out.size(), "%s", where.dli_sname);
    else
      std::snprintf(out.data(), out.size(), "an unnamed function at offset 0x%zx",
                    static_cast<std::size_t>(static_cast<char*>(frames[static_cast<std::size_t>(i)]) -
                                             static_cast<char*>(where.dli_fbase)));
    return;
  }
}

/// As people write it.
inline std::string Demangled(const FunctionName& name) {
  int status = 0;
  char* text = abi::__cxa_demangle(name.data(), nullptr, nullptr, &status);
  const std::string out = status == 0 ? text : name.data();
  std::free(text);
  return out;
}

}  // namespace reed::bench
