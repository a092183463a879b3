// A law of reed/law.h that asks a Python process for every torque (tools/reed_tools/law/server.py): for trying an idea
// in ten lines. It waits for the answer, so it is for lockstep. The argument is the law's file; the environment names
// the interpreter and the server (REED_LAW_PYTHON, REED_LAW_SERVER).
//
// Down the pipe, native byte order: int32 count of doubles, then the doubles in the order of Ask().
// Up: int32 count, the torques and the named values (at the start also the traits, then int32 length and the names, one a
// line), or int32 -length and a line that says what is wrong.
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "reed/law.h"

namespace {

constexpr int kMostJoints = 8, kMostParameters = 12, kMostText = 400;
constexpr int kMostAnswers = kMostJoints + REED_LAW_MAX_VALUES + 1;  // torques, values, traits
constexpr int kMostNumbers = 8 + kMostJoints * 11 + kMostParameters * (kMostJoints + 1);

// Of the one law of this process.
std::uint32_t traits = 0;
int num_values = 0;
std::array<char, kMostText> name_text{};
std::array<const char*, REED_LAW_MAX_VALUES + 1> names{};  // into name_text, nullptr behind the last

struct State {
  int pipe;
  pid_t child;
  char text[kMostText];
};

bool WriteAll(int to, const void* data, std::size_t size) noexcept {
  const char* next = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t n = send(to, next, size, MSG_NOSIGNAL);
    if (n <= 0) return false;
    next += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

bool ReadAll(int from, void* data, std::size_t size) noexcept {
  char* next = static_cast<char*>(data);
  while (size > 0) {
    const ssize_t n = read(from, next, size);
    if (n <= 0) return false;
    next += n;
    size -= static_cast<std::size_t>(n);
  }
  return true;
}

/// The numbers of one question, one after the other.
class Numbers {
 public:
  void Add(double value) noexcept { values_[static_cast<std::size_t>(count_++)] = value; }
  void Add(const double* values, int count) noexcept {
    for (int i = 0; i < count; ++i) Add(values[i]);
  }
  bool Send(int to) const noexcept {
    return WriteAll(to, &count_, sizeof count_) &&
           WriteAll(to, values_.data(), static_cast<std::size_t>(count_) * sizeof(double));
  }

 private:
  std::array<double, kMostNumbers> values_;
  std::int32_t count_ = 0;
};

void Ask(const reed_law_input& in, Numbers& out) noexcept {
  const int n = in.joints, m = in.parameters;
  for (const double value : {static_cast<double>(n), static_cast<double>(m), in.period_s, in.time_s,
                             static_cast<double>(in.adapt), static_cast<double>(in.source), in.f_n})
    out.Add(value);
  for (const double* values : {in.theta, in.theta_dot, in.theta_d, in.theta_d_dot, in.theta_d_ddot, in.v,
                               in.v_dot, in.s, in.f_known, in.J_m, in.Jt_F_d})
    out.Add(values, n);
  out.Add(in.p_0, m);
  out.Add(in.Y, n * m);
}

/// False: text holds what the server said, or that it is gone.
bool Answer(State& state, int wanted, double* numbers) noexcept {
  std::int32_t count = 0;
  std::strcpy(state.text, "the Python process has ended");
  if (!ReadAll(state.pipe, &count, sizeof count)) return false;
  if (count == wanted) return ReadAll(state.pipe, numbers, static_cast<std::size_t>(wanted) * sizeof(double));
  const std::size_t length = static_cast<std::size_t>(count < 0 ? -count : 0);
  if (length >= sizeof state.text || !ReadAll(state.pipe, state.text, length)) return false;
  state.text[length] = '\0';
  return false;
}

/// The names of the values, one a line; the server has checked them.
bool ReadNames(State& state) noexcept {
  std::int32_t length = 0;
  if (!ReadAll(state.pipe, &length, sizeof length) || length < 0 || length >= kMostText) return false;
  if (!ReadAll(state.pipe, name_text.data(), static_cast<std::size_t>(length))) return false;
  char* next = name_text.data();
  while (*next != '\0' && num_values < REED_LAW_MAX_VALUES) {
    names[static_cast<std::size_t>(num_values++)] = next;
    next = std::strchr(next, '\n');
    if (next == nullptr) break;
    *next++ = '\0';
  }
  return true;
}

const char* StartServer(State& state, const char* file) {
  const char *python = std::getenv("REED_LAW_PYTHON"), *server = std::getenv("REED_LAW_SERVER");
  if (python == nullptr || server == nullptr)
    return "a Python law is started by tools/reed run --law FILE.py";
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
    return "no socket for the Python process";
  state.child = fork();
  if (state.child < 0) return "no process for Python";
  if (state.child == 0) {
    dup2(ends[1], STDIN_FILENO);  // both ways; standard output and error stay the firmware's
    execl(python, python, "-I", server, file, static_cast<char*>(nullptr));
    _exit(127);
  }
  close(ends[1]);
  state.pipe = ends[0];
  return nullptr;
}

}  // namespace

uint32_t reed_law_version(void) { return REED_LAW_VERSION; }

size_t reed_law_state_size(const reed_law_setup* /*setup*/) { return sizeof(State); }

const char* reed_law_start(const reed_law_setup* setup, void* memory) {
  State& state = *static_cast<State*>(memory);
  if (setup->joints > kMostJoints || setup->parameters > kMostParameters)
    return "too many joints or parameters for a Python law";
  if (const char* refused = StartServer(state, setup->argument)) return refused;
  Numbers question;  // the arm, for the first call: the server tries the law on it
  for (const double value :
       {static_cast<double>(setup->joints), static_cast<double>(setup->parameters), setup->period_s})
    question.Add(value);
  for (const double* values : {setup->K_d, setup->Lambda, setup->J_m}) question.Add(values, setup->joints);
  question.Add(setup->p_0, setup->parameters);
  std::array<double, kMostAnswers> first{};  // the torques of its trial, and the law's traits
  if (question.Send(state.pipe) && Answer(state, setup->joints + 1, first.data()) && ReadNames(state)) {
    traits = static_cast<std::uint32_t>(first[static_cast<std::size_t>(setup->joints)]);
    return nullptr;
  }
  reed_law_stop(memory);
  return state.text;
}

uint32_t reed_law_traits(void) { return traits; }

const char* const* reed_law_value_names(void) { return names.data(); }

void reed_law_step(const reed_law_input* in, void* memory, reed_law_output* out) {
  State& state = *static_cast<State*>(memory);
  Numbers question;
  Ask(*in, question);
  std::array<double, kMostAnswers> numbers{};
  if (question.Send(state.pipe) && Answer(state, in->joints + num_values, numbers.data())) {
    std::copy_n(numbers.begin(), in->joints, out->torque);
    std::copy_n(numbers.begin() + in->joints, num_values, out->values);
    return;
  }
  for (int i = 0; i < in->joints; ++i)
    out->torque[i] = std::numeric_limits<double>::quiet_NaN();  // trips: not finite
  static bool said = false;
  if (!said) std::fprintf(stderr, "reed_firmware: --law: %s\n", state.text);
  said = true;
}

void reed_law_stop(void* memory) {
  State& state = *static_cast<State*>(memory);
  close(state.pipe);
  waitpid(state.child, nullptr, 0);
}
