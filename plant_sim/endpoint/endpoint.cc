#include "reed/plant/endpoint/endpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reed_layout.h"

namespace reed::plant {
namespace {

constexpr double kShapes_hz = 60.0;  // what an eye can follow

}  // namespace

Endpoint::Endpoint(const PlantConfig& config, bus::Transport& transport, ArmBody& body, RecordSink& recorder,
                   std::unique_ptr<bus::ArmCodec> codec)
    : period_s_(1.0 / config.timing.rate_hz),
      shape_every_cycles_(
          static_cast<std::uint32_t>(std::max(1L, std::lround(config.timing.rate_hz / kShapes_hz)))),
      timeout_periods_(config.drives.command_timeout_cycles),
      body_(body),
      faults_(Injector::For(config, body, transport)),
      journal_(recorder),
      robot_(config, faults_ ? faults_->body() : body, journal_),
      port_(faults_ ? faults_->transport() : transport, std::move(codec)),
      first_cycle_(config.timing.first_cycle) {}

bool Endpoint::Poll(std::int64_t deadline_ns) {
  const auto incoming = port_.Receive(deadline_ns);
  if (!port_.alive()) {
    Fail(Outcome::kBusLost, "the bus is lost: its interface went away");
    return false;
  }
  Handle(incoming);
  if (port_.another_arm() && !told_of_another_arm_) TellOfAnotherArm();
  return !incoming.empty();
}

void Endpoint::TellOfAnotherArm() noexcept {
  told_of_another_arm_ = true;
  journal_.Note(PlantEvent::kAnotherArm, robot_.drives().state(), robot_.time_s(),
                "another arm answers on this bus; end one of the two: the controller takes whose frame comes "
                "first");
}

bool Endpoint::Accept(const Incoming& sync, std::int64_t utime) {
  if (sync.sync.layout != bus::layout::kLayoutId) {
    Fail(Outcome::kWrongLayout,
         "the controller speaks another bus layout: SYNC carries layout " + std::to_string(sync.sync.layout) +
             ", this program was built with layout " + std::to_string(bus::layout::kLayoutId) +
             " (bus/reed.dbc); build both programs from the same source");
    return false;
  }
  journal_.Stamp(sync.count, utime);
  count_ = sync.count;
  if (sync.new_controller) {
    const bool first = syncs_ == 0;
    if (faults_) faults_->Reset();
    robot_.Reset();
    journal_.Note(first ? PlantEvent::kControllerPresent : PlantEvent::kControllerRestarted,
                  robot_.drives().state(), 0.0,
                  first ? "controller present: SYNC %u" : "another controller: SYNC %u, the arm starts over",
                  sync.sync.cycle);
  }
  ++syncs_;
  return true;
}

void Endpoint::Sample(std::uint32_t cycle, const HostPauses& host) {
  Measurement measurement = robot_.Measure();
  if (faults_) Disturb(measurement);
  port_.Answer(cycle, measurement);
  journal_.Put(robot_.Snapshot(host));
  if (cycle % shape_every_cycles_ == 0) journal_.Put(robot_.ShapeSnapshot());
}

void Endpoint::Disturb(Measurement& measurement) noexcept {
  faults_->Step(count_ - first_cycle_, robot_.time_s(), robot_.enabled_for_s(), robot_.drives().state(),
                measurement);
  for (const FaultChange& change : faults_->TakeChanges())
    journal_.Note(change.begins ? PlantEvent::kFaultBegins : PlantEvent::kFaultEnds, robot_.drives().state(),
                  static_cast<double>(change.fault), "fault %s %s: %s of %s at %.3f s", change.id,
                  change.begins ? "begins" : "ends", change.kind, change.target, robot_.time_s());
}

void Endpoint::CheckHealth() {
  if (robot_.healthy() || outcome_ != Outcome::kRunning) return;
  Fail(Outcome::kDiverged, "the simulated arm diverged: " + body_.fault_description() + "; brakes closed");
  journal_.Note(PlantEvent::kDiverged, robot_.drives().state(), robot_.time_s(), "%s", failure_.c_str());
}

void Endpoint::Fail(Outcome outcome, const std::string& line) {
  outcome_ = outcome;
  failure_ = line;
}

}  // namespace reed::plant
