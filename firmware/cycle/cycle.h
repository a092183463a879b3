// One period of the arm, readable top to bottom: frames in, one step of the controller, frames out, a record.
// RT: safe, except the constructor.
#pragma once

#include <memory>
#include <utility>

#include "reed/core/controller.h"
#include "reed/firmware/arm_bus/arm_bus.h"
#include "reed/firmware/cycle/cycle_base.h"
#include "reed/firmware/cycle/fill.h"
#include "reed/firmware/setup/planned_path.h"

namespace reed {

template <int N, int P>
class Cycle final : public CycleBase {
 public:
  Cycle(const Settings<N, P>& settings, reference::PlannedPath<N> path, bus::Transport& transport,
        std::unique_ptr<bus::ControllerCodec> codec, const strategy::ExternalLaw* external)
      : path_(std::move(path)),
        codec_(std::move(codec)),
        bus_(transport, *codec_),
        controller_(settings, path_.View(), external),
        external_(external) {}

  CycleStatus Run(std::uint32_t cycle, std::int64_t rx_deadline_ns, const CycleState& loop,
                  telemetry::Snapshot& snapshot) noexcept override {
    bus_.SendSync(cycle, snapshot);
    CycleState state = loop;
    state.all_answered = bus_.Receive(rx_deadline_ns, snapshot);  // receive
    const std::int64_t received = rt::NowNs();

    const Measurement<N>& measured = bus_.measurement();
    const Command<N>& command = controller_.Step(measured, state);  // estimate, decide, control, protect
    const std::int64_t computed = rt::NowNs();

    const int cut = bus_.SendCommand(command, computed - snapshot.time_ns, snapshot);  // send
    const std::int64_t sent = rt::NowNs();

    Record(measured, snapshot);  // record
    NoteCut(cut, command, snapshot);
    snapshot.timing.rx_ns = rt::ShortNs(received - snapshot.time_ns);
    snapshot.timing.compute_ns = rt::ShortNs(computed - received);
    snapshot.timing.tx_ns = rt::ShortNs(sent - computed);
    snapshot.timing.cycle_ns = rt::ShortNs(sent - snapshot.time_ns);
    if (!bus_.alive()) return CycleStatus::kBusLost;
    return controller_.finished(loop.stop_wanted) ? CycleStatus::kFinished : CycleStatus::kRunning;
  }

  mode::Mode mode() const noexcept override { return controller_.mode(); }
  protect::Reason trip() const noexcept override { return controller_.trip(); }
  TripPlace trip_place() const noexcept override { return controller_.trip_place(); }

 private:
  /// Once for each row of cycles whose command the bus could not carry.
  void NoteCut(int joint, const Command<N>& command, telemetry::Snapshot& snapshot) noexcept {
    if (joint >= 0 && last_cut_ < 0) {
      EventList events;
      events.Add({protect::Reason::kCommandCut, joint, command.torque[joint], controller_.mode(),
                  controller_.decision().source});
      telemetry::FillEvents(events, snapshot);
    }
    last_cut_ = joint;
  }

  void Record(const Measurement<N>& measured, telemetry::Snapshot& snapshot) noexcept {
    snapshot.dof = N;
    snapshot.num_parameters = controller_.settings().arm.num_parameters;
    telemetry::FillEvents(controller_.events(), snapshot);
    telemetry::FillMeasured(measured, snapshot.measured);
    telemetry::FillControl(controller_, snapshot.control);
    telemetry::FillAdaptation(controller_.strategy().adaptive(), snapshot.adaptation);
    telemetry::FillLaw(external_, snapshot);
    telemetry::FillBus(bus_.transport_counters(), bus_.decode_counters(), bus_.late_frames(), snapshot.bus);
  }

  reference::PlannedPath<N> path_;  // the knots that the controller reads
  std::unique_ptr<bus::ControllerCodec> codec_;
  ArmBus<N> bus_;
  Controller<N, P> controller_;
  int last_cut_ = -1;                      // joint whose command was cut in the last cycle
  const strategy::ExternalLaw* external_;  // nullptr: a law of the bank
};

}  // namespace reed
