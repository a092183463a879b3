// Runs a recorded closed loop through the controller, cycle by cycle: the measurement as the drives' frames carry it,
// one step, the command as a drive reads it. Prints the torques of every cycle as their 64 bits, then how many
// instructions a step took (worst and median) and how deep the stack was, where the platform knows.
// Host and target alike.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>

#include "reed/bus/codec/messages.h"
#include "reed/core/controller.h"
#include "reed/embedded/platform.h"
#include "reed/embedded/recorded_loop.h"

namespace reed::embedded {
namespace {

using Knot = reference::JointPath<N>::Knot;
constexpr std::size_t kMostKnots = 1200, kMostCycles = 4000;

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

std::span<const Knot> Knots() noexcept {
  static Knot knots[kMostKnots];
  const double* next = kKnots;
  for (Knot& knot : std::span(knots, kNumKnots))
    for (auto* part : {&knot.q, &knot.q_dot, &knot.q_ddot})
      for (double& value : *part) value = *next++;
  return {knots, kNumKnots};
}

/// Frames of the drives on their way in: what the decoder makes of them is what the controller sees.
class Wire {
 public:
  Measurement<N> Carry(Measurement<N> m) noexcept {
    for (int i = 0; i < N; ++i) {
      const std::size_t at = static_cast<std::size_t>(i);
      if (m.age[at] != 0) continue;
      const bus::JointStateMessage sent{m.theta[i], m.theta_dot[i], m.torque[i],
                                        static_cast<bus::DriveState>(m.drive[at]), 0};
      const bus::JointStateMessage state = from_drives_.Decode(drives_.JointState(i, sent)).joint_state;
      m.theta[i] = state.position_rad;
      m.theta_dot[i] = state.velocity_radps;
      m.torque[i] = state.torque_Nm;
    }
    return m;
  }
  model::Vec<N> Carry(const Command<N>& command) noexcept {
    bus::CommandMessage message{0, static_cast<bus::DriveRequest>(command.request), {}};
    for (int i = 0; i < N; ++i) message.torque_Nm[static_cast<std::size_t>(i)] = command.torque[i];
    const bus::Decoded decoded = at_drive_.Decode(controller_.Command(message));
    model::Vec<N> torque;
    for (int i = 0; i < N; ++i) torque[i] = decoded.command.torque_Nm[static_cast<std::size_t>(i)];
    return torque;
  }

 private:
  bus::FrameEncoder drives_, controller_;
  bus::Decoder from_drives_, at_drive_;
};

void Run() {
  static Settings<N, P> settings;
  const double* next = kSettings;
  VisitSettings([&](double& value) { value = *next++; }, settings);
  static Controller<N, P> controller(settings, {Knots(), kSpacing_s});
  static Wire wire;
  static std::uint32_t took[kMostCycles];
  for (std::size_t k = 0; k < kNumCycles; ++k) {
    const Measurement<N> recorded = MeasurementFrom(kRecorded[k]);
    const std::uint32_t before = Instructions();
    const Measurement<N> measured = wire.Carry(recorded);
    CycleState state;
    state.all_answered = measured.OldestAge() == 0;
    const Command<N>& command = controller.Step(measured, state);
    const model::Vec<N> torque = wire.Carry(command);
    took[k] = Instructions() - before;
    for (const model::Vec<N>* each : {&command.torque, &torque}) {
      for (const double number : *each) {
        std::uint64_t bits = 0;
        std::memcpy(&bits, &number, sizeof bits);
        PrintHex(bits);
      }
    }
    Print("\n");
  }
  std::sort(took, took + kNumCycles);
  Number("instructions", took[kNumCycles - 1]);
  Number("instructions_median", took[kNumCycles / 2]);
  Number("stack", StackUsed());
}

}  // namespace
}  // namespace reed::embedded

int main() {
  reed::embedded::Run();
  reed::embedded::End();
}
