// The loop's proofs for one law from outside, on the control step of the arm a5: heap, system calls, exceptions, finite
// torques, page faults, time. reed_law_budget LIB.so[:ARGUMENT], or --count LIB.so… for instructions under callgrind.
// One JSON line a proof: {"proof": …, "broken": count, "what": …, "where": function of the library}.
#include <fcntl.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstddef>
#include <exception>
#include <filesystem>

#include "reed/bench/control_step.h"
#include "reed/bench/offender.h"
#include "reed/config/controller/load_controller_config.h"
#include "reed/config/description/config_error.h"
#include "reed/firmware/law_plugin/law_plugin.h"
#include "reed/rt/heap_guard.h"

namespace reed::bench {
namespace {

using Step = ControlStep<5, 7>;
constexpr int kSteps = 2000, kTimed = 20000;

std::string g_library;      // absolute path, as dladdr() has it
FunctionName g_offender{};  // of the first broken promise
int g_report = -1;          // where a child says what it saw
std::FILE* g_out = stdout;  // of this program, not of the law

void Print(const char* proof, long broken, const std::string& what) {
  std::fprintf(g_out, "{\"proof\": \"%s\", \"broken\": %ld, \"what\": \"%s\", \"where\": \"%s\"}\n", proof,
               broken, what.c_str(), Demangled(g_offender).c_str());
  std::fflush(g_out);
  g_offender[0] = '\0';
}

void RememberOffender() noexcept {
  if (g_offender[0] == '\0') NameOffender(g_library.c_str(), g_offender);
}

void Heap(Step& step) {
  rt::HeapCount::SetWitness(RememberOffender);
  long calls = 0;
  {
    const rt::HeapCount count;
    for (int k = 0; k < kSteps; ++k) step.Run(k);
    calls = count.calls();
  }
  rt::HeapCount::SetWitness(nullptr);
  Print("heap", calls, "calls of malloc, free and their family");
}

void PageFaults(Step& step) {
  rusage before{}, after{};
  getrusage(RUSAGE_THREAD, &before);
  for (int k = 0; k < kSteps; ++k) step.Run(k);
  getrusage(RUSAGE_THREAD, &after);
  Print("page_faults", after.ru_minflt + after.ru_majflt - before.ru_minflt - before.ru_majflt,
        "page faults");
}

void Finite(Step& step) {
  long broken = 0;
  for (int k = 0; k < kSteps; ++k) {
    step.Run(k);
    for (const double torque : step.controller().decision().tau_law) broken += std::isfinite(torque) ? 0 : 1;
  }
  Print("finite", broken, "torques that are no finite number");
}

[[noreturn]] void Report(const char* text) noexcept {
  (void)!write(g_report, text, std::strlen(text));
  (void)!write(g_report, "\n", 1);
  (void)!write(g_report, g_offender.data(), std::strlen(g_offender.data()));
  _exit(1);
}

void OnSystemCall(int /*signal*/, siginfo_t* info, void* /*context*/) {
  RememberOffender();
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), "system call %d", info->si_syscall);
  Report(text.data());
}

/// From here on every system call but exit and writing the report ends in OnSystemCall.
bool TrapSystemCalls() {
  struct sigaction action {};
  action.sa_sigaction = OnSystemCall;
  action.sa_flags = SA_SIGINFO;
  sigaction(SIGSYS, &action, nullptr);
  sock_filter filter[] = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 4, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_rt_sigreturn, 3, 0),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_write, 0, 3),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, args[0])),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, static_cast<unsigned>(g_report), 0, 1),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
      BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_TRAP),
  };
  const sock_fprog program{static_cast<unsigned short>(std::size(filter)), filter};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

[[noreturn]] void OnTerminate() {
  std::string what = "an exception";
  try {
    std::rethrow_exception(std::current_exception());
  } catch (const std::exception& error) {
    what += ": " + std::string(error.what());
  } catch (...) {
    what += " of no standard type";
  }
  RememberOffender();
  Report(what.c_str());
}

/// Runs `steps` in a process of their own, which may end at any of them.
template <typename Steps>
bool InChild(const char* proof, Steps&& steps) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw std::runtime_error("no pipe");
  const pid_t child = fork();
  if (child == 0) {
    g_report = ends[1];
    std::set_terminate(OnTerminate);
    try {
      steps();
    } catch (const std::exception& error) {  // the bench's own: a law's exception ends in OnTerminate
      Report(error.what());
    }
    _exit(0);
  }
  close(ends[1]);
  std::string report;
  std::array<char, 512> text{};
  for (ssize_t n = 0; (n = read(ends[0], text.data(), text.size())) > 0;)
    report.append(text.data(), static_cast<std::size_t>(n));
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  const std::size_t line = report.find('\n');
  if (line != std::string::npos)
    std::snprintf(g_offender.data(), g_offender.size(), "%s", report.c_str() + line + 1);
  if (!whole && report.empty())
    report =
        WIFSIGNALED(status) ? std::string("signal ") + sigdescr_np(WTERMSIG(status)) : "the process ended";
  Print(proof, whole ? 0 : 1, whole ? "" : report.substr(0, line));
  return whole;
}

/// Worst and median of one step, beside the built-in law's, in turns: machines drift.
void Time(Step& step, Step& built_in) {
  const rt::MonotonicClock clock;
  const auto once = [&clock](Step& each, int k) {
    const std::int64_t start = clock.NowNs();
    Keep(each.Run(k));
    return clock.NowNs() - start;
  };
  std::vector<std::int64_t> mine, theirs;
  for (int k = 0; k < kTimed; ++k) {
    mine.push_back(once(step, k));
    theirs.push_back(once(built_in, k));
  }
  std::sort(mine.begin(), mine.end());
  std::sort(theirs.begin(), theirs.end());
  std::fprintf(g_out,
               "{\"proof\": \"time\", \"median_ns\": %lld, \"worst_ns\": %lld, \"built_in_median_ns\": %lld, "
               "\"built_in_worst_ns\": %lld}\n",
               static_cast<long long>(mine[kTimed / 2]), static_cast<long long>(mine.back()),
               static_cast<long long>(theirs[kTimed / 2]), static_cast<long long>(theirs.back()));
}

/// What the law prints is not part of the proofs.
void SilenceTheLaw() {
  g_out = fdopen(dup(STDOUT_FILENO), "w");
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  dup2(nowhere, STDOUT_FILENO);
}

void Prove(const ControllerConfig& scenario, const strategy::ExternalLaw& law) {
  const bool runs = InChild("exceptions", [&] {
    Step step(scenario, &law);
    for (int k = 0; k < kSteps; ++k) step.Run(k);
  });
  if (!runs) return;
  Step step(scenario, &law), built_in(scenario);
  Finite(step);
  Heap(step);
  PageFaults(step);
  InChild("system_calls", [&] {
    if (!TrapSystemCalls()) Report("seccomp is refused here");
    for (int k = 0; k < kSteps; ++k) step.Run(k);
  });
  Time(step, built_in);
}

int Run(int argc, char** argv) {
  const bool counting = argc > 2 && std::strcmp(argv[1], "--count") == 0;
  const std::string spec = argv[counting ? 2 : 1];
  const ControllerConfig scenario = LoadControllerConfig("press_known");
  const std::unique_ptr<LawPlugin> plugin = OpenLaw(spec, scenario);
  g_library = std::filesystem::absolute(spec.substr(0, spec.find(':')));
  PrepareBacktraces();
  if (counting) {
    Step step(scenario, &plugin->law());
    Stopwatch(argc, argv).Measure("step", [&](int k) { Keep(step.Run(k)); });
    return 0;
  }
  SilenceTheLaw();
  Prove(scenario, plugin->law());
  std::fflush(g_out);
  return 0;
}

}  // namespace
}  // namespace reed::bench

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw reed::ConfigError("reed_law_budget [--count] LIB.so[:ARGUMENT]");
    return reed::bench::Run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "reed_law_budget: %s\n", error.what());
    return 2;
  }
}
