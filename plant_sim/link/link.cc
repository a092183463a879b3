#include "reed/plant/link/link.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "reed/bus/codec/wire_time.h"
#include "reed/rt/grid.h"
#include "reed_layout.h"

namespace reed::plant {
namespace {

constexpr std::int64_t kAnyTime_ns = std::numeric_limits<std::int64_t>::max();
constexpr double kLongestReceive = 0.8;  // of the period: the controller computes, too

/// As the controller's own (firmware/startup/checks.h).
std::int64_t ReceivePhase_ns(const TimingConfig& timing, int joints) {
  const double period_s = 1.0 / timing.rate_hz;
  const double given_s = 1e-6 * timing.rx_budget_us;
  const double free_s = std::max(bus::kReceiveShare * period_s, bus::AnswerTime_s(joints));
  return std::llround(1e9 * std::min(given_s > 0.0 ? given_s : free_s, kLongestReceive * period_s));
}

}  // namespace

Link::Link(const LinkConfig& config, const TimingConfig& timing, int joints, std::int64_t seed)
    : has_wire_(config.wire_time),
      period_ns_(rt::PeriodNs(timing.rate_hz)),
      receive_ns_(ReceivePhase_ns(timing, joints)),
      controller_ns_(std::llround(1e9 * config.controller_s)),
      wire_({config.wire_time ? config.foreign_load : 0.0, config.foreign_id,
             static_cast<std::uint64_t>(seed)}),
      commands_(config.command, seed, stream::kCommand),
      measurements_(config.measurement, seed, stream::kMeasurement) {}

std::int64_t Link::Start(std::int64_t cycle_ns, const bus::Frame& sync) noexcept {
  over_ = now_;
  now_ = {};
  cycle_ns_ = asked_ns_ = cycle_ns;
  missing_ = 0;
  if (!has_wire_) return asked_ns_;
  Offer(sync, cycle_ns);
  while (const auto sent = wire_.Next(kAnyTime_ns)) {
    Deliver(*sent);
    if (sent->frame.id == sync.id) break;
  }
  return asked_ns_;
}

void Link::Answer(std::span<const bus::Frame> frames) noexcept {
  missing_ = static_cast<int>(frames.size());
  complete_ns_ = asked_ns_;
  for (const bus::Frame& frame : frames) {
    if (has_wire_)
      Offer(frame, asked_ns_);
    else
      ToController(frame, asked_ns_, true);
  }
  const std::int64_t end_ns = cycle_ns_ + receive_ns_;
  while (has_wire_ && missing_ > 0) {
    const auto sent = wire_.Next(end_ns);
    if (!sent) break;
    Deliver(*sent);
  }
  if (missing_ > 0) complete_ns_ = std::max(asked_ns_, end_ns);
}

std::optional<bus::Frame> Link::TakeForController() noexcept {
  const Underway* first = underway_.Front();
  if (first == nullptr || first->arrives_ns > cycle_ns_ + receive_ns_) return std::nullopt;
  const bus::Frame frame = first->frame;
  underway_.PopFront();
  return frame;
}

void Link::Command(const bus::CommandMessage& message, const bus::Frame& frame) noexcept {
  if (!has_wire_) {  // lockstep's own period
    ToDrives(message, cycle_ns_ + period_ns_);
    return;
  }
  if (!on_wire_.Push(message)) {
    ++dropped_;
    return;
  }
  Offer(frame, complete_ns_ + controller_ns_);
  while (const auto sent = wire_.Next(cycle_ns_ + period_ns_)) Deliver(*sent);
}

void Link::Offer(const bus::Frame& frame, std::int64_t ready_ns) noexcept {
  while (!wire_.Offer(frame, ready_ns)) {  // full: what waits longest is given up by being sent
    const auto sent = wire_.Next(kAnyTime_ns);
    if (!sent) return;
    ++dropped_;
    Deliver(*sent);
  }
}

void Link::Deliver(const bus::Sent& sent) noexcept {
  const bool of_this_cycle = sent.offered_ns >= cycle_ns_;
  const double took_s = 1e-9 * static_cast<double>(sent.arrived_ns - sent.offered_ns);
  if (sent.frame.id == bus::layout::kSync.id) {
    asked_ns_ = sent.arrived_ns;
  } else if (sent.frame.id == bus::layout::kCommand.id) {
    now_.command_s = took_s;
    if (const bus::CommandMessage* message = on_wire_.Front()) {
      ToDrives(*message, sent.arrived_ns);
      on_wire_.PopFront();
    }
  } else {
    now_.answers_s = std::max(
        now_.answers_s,
        1e-9 * static_cast<double>(sent.arrived_ns - (of_this_cycle ? cycle_ns_ : cycle_ns_ - period_ns_)));
    ToController(sent.frame, sent.arrived_ns, of_this_cycle);
  }
}

void Link::ToController(const bus::Frame& frame, std::int64_t sent_ns, bool of_this_cycle) noexcept {
  if (measurements_.Loses()) return;
  const std::int64_t arrives_ns = measurements_.Arrival(sent_ns);
  if (!underway_.Push({frame, arrives_ns})) {
    ++dropped_;
    return;
  }
  if (!of_this_cycle || arrives_ns > cycle_ns_ + receive_ns_) return;
  --missing_;
  complete_ns_ = std::max(complete_ns_, arrives_ns);
}

void Link::ToDrives(const bus::CommandMessage& message, std::int64_t sent_ns) noexcept {
  if (commands_.Loses()) return;
  if (!heard_.Push({message, commands_.Arrival(sent_ns)})) ++dropped_;
}

}  // namespace reed::plant
