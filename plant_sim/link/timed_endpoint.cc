#include "reed/plant/link/timed_endpoint.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "reed/bus/codec/wire_time.h"
#include "reed/plant/endpoint/lockstep_endpoint.h"
#include "reed/rt/grid.h"

namespace reed::plant {
TimedEndpoint::TimedEndpoint(const PlantConfig& config, std::unique_ptr<LinkTransport> bus, ArmBody& body,
                             RecordSink& sink)
    : Endpoint(config, *bus, body, sink),
      bus_(std::move(bus)),
      rate_hz_(config.timing.rate_hz),
      period_ns_(rt::PeriodNs(rate_hz_)),
      computed_answers_us_(1e6 * bus::AnswerTime_s(config.arm.dof())),
      computed_command_us_(1e6 * bus::CommandTime_s()) {}

void TimedEndpoint::Handle(std::span<const Incoming> incoming) {
  for (const Incoming& in : incoming) {
    if (outcome() != Outcome::kRunning) return;
    if (in.kind == Incoming::Kind::kSync) {
      OnSync(in);
    } else if (syncs() > 0 && in.command.cycle == cycle_) {
      bus_->link().Command(in.command, bus_->command());
    } else {
      CountRefusedCommand();
    }
  }
}

void TimedEndpoint::OnSync(const Incoming& sync) {
  if (!Accept(sync, std::llround(static_cast<double>(sync.count) * 1e6 / rate_hz_))) return;
  if (sync.new_controller) {
    bus_->StartOver();
    cycle_ns_ = now_ns_ = 0;
  } else {
    cycle_ns_ += period_ns_ * std::min(sync.count - count_, std::int64_t{kMaxGapCycles} + 1);
  }
  count_ = sync.count;
  cycle_ = sync.sync.cycle;
  Link& link = bus_->link();
  AdvanceTo(link.Start(cycle_ns_, bus_->sync()));
  if (outcome() != Outcome::kRunning) return;
  Sample(cycle_);
  if (link.has_wire()) {
    const WireTimes& times = link.times();
    journal().Put(WireRecord{.answers_us = 1e6 * times.answers_s,
                             .command_us = 1e6 * times.command_s,
                             .foreign_s = link.foreign_s(),
                             .dropped = link.dropped(),
                             .computed_answers_us = computed_answers_us_,
                             .computed_command_us = computed_command_us_});
  }
}

void TimedEndpoint::AdvanceTo(std::int64_t to_ns) {
  Link& link = bus_->link();
  while (now_ns_ < to_ns && outcome() == Outcome::kRunning) {
    const HeardCommand* next = link.NextCommand();
    if (next != nullptr && next->at_ns <= now_ns_) {
      Follow(next->message);
      link.PopCommand();
      continue;
    }
    const std::int64_t end_ns = next != nullptr ? std::min(to_ns, next->at_ns) : to_ns;
    const std::int64_t step_ns = end_ns - now_ns_;
    const double step_s = step_ns == period_ns_ ? period_s_ : 1e-9 * static_cast<double>(step_ns);
    mutable_robot().Advance(step_s);
    mutable_robot().Silence(step_s / period_s_);
    now_ns_ = end_ns;
    CheckHealth();
  }
}

/// One that answers a SYNC of long ago is a stray.
void TimedEndpoint::Follow(const bus::CommandMessage& command) {
  const bool recent = cycle_ - command.cycle <= timeout_periods_;  // modulo 2^32
  if (!recent || !mutable_robot().Command(command)) CountRefusedCommand();
}

std::unique_ptr<Endpoint> MakeLockstepEndpoint(const PlantConfig& config, bus::Transport& bus, ArmBody& body,
                                               RecordSink& sink) {
  if (!config.link.active()) return std::make_unique<LockstepEndpoint>(config, bus, body, sink);
  return std::make_unique<TimedEndpoint>(config, std::make_unique<LinkTransport>(bus, config), body, sink);
}

}  // namespace reed::plant
