// What every program of ours does around its own work. RT: set-up only.
#pragma once

#include <cstdio>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

namespace reed::rt {

/// Standard streams that are closed become /dev/null, so that no log or socket is opened under their number and gets the
/// complaints. A reader that leaves (SIGPIPE) and a file that may not grow (SIGXFSZ) end no program: the write fails, and who
/// wrote counts it.
void PrepareProcess() noexcept;

/// An end with a line for people and an exit status of its own.
class Failure : public std::runtime_error {
 public:
  Failure(const std::string& line, int status) : std::runtime_error(line), status_(status) {}
  int status() const noexcept { return status_; }

 private:
  int status_;
};

inline constexpr int kBadInput = 2, kDied = 3;

/// The body of a main: runs `work()` and turns whatever it throws into one line and an exit status: that of a Failure, 2 for
/// bad input (any other exception of the standard's kind), 3 when memory is out or nobody knows what was thrown.
template <typename Work>
int RunProgram(const char* name, Work&& work) noexcept {
  PrepareProcess();
  try {
    return work();
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s: %s\n", name, failure.what());
    return failure.status();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: out of memory\n", name);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return kBadInput;
  } catch (...) {
    std::fprintf(stderr, "%s: ended by an exception of unknown kind\n", name);
  }
  return kDied;
}

}  // namespace reed::rt
