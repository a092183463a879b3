// The simulated arm at the other end of a wire in memory: it works whenever the controller waits for its
// answers, on the controller's thread. RT: as the endpoint.
#pragma once

#include <exception>
#include <memory>

#include "reed/bus/transport/memory_transport.h"
#include "reed/plant/endpoint/flexible_arm_body.h"
#include "reed/plant/link/timed_endpoint.h"
#include "reed/rt/heap_guard.h"
#include "reed/rt/usage.h"

namespace reed {

class PlantSide {
 public:
  /// `wire` and `recorder` outlive it.
  PlantSide(const PlantConfig& config, bus::MemoryWire& wire, plant::RecordSink& recorder)
      : body_(config),
        endpoint_(plant::MakeLockstepEndpoint(config, wire.plant, body_, recorder)),
        controller_(wire.controller) {
    controller_.OnReceive([this] { Work(); });
  }
  PlantSide(const PlantSide&) = delete;
  PlantSide& operator=(const PlantSide&) = delete;

  const plant::Endpoint& endpoint() const noexcept { return *endpoint_; }
  /// Throws what the arm threw, if it did.
  void Rethrow() const {
    if (failure_ != nullptr) std::rethrow_exception(failure_);
  }
  /// What the arm cost the kernel on the controller's thread.
  const rt::Usage& usage() const noexcept { return usage_; }

 private:
  void Work() noexcept {
    const rt::HeapPause not_the_controllers;
    if (endpoint_->syncs() > 0) {
      Poll();
      return;
    }
    const rt::Usage before =
        rt::ThreadUsage();  // the first SYNC sets the arm up; later the kernel has no work
    Poll();
    usage_ += rt::ThreadUsage() - before;
  }

  /// An arm that failed answers no more, and the controller hears of it at once.
  void Poll() noexcept {
    try {
      if (failure_ == nullptr) endpoint_->Poll(0);
    } catch (...) {  // a pose without equilibrium, at the first SYNC
      failure_ = std::current_exception();
    }
    if (failure_ != nullptr || endpoint_->outcome() != plant::Outcome::kRunning) controller_.Cut();
  }

  plant::FlexibleArmBody body_;
  std::unique_ptr<plant::Endpoint> endpoint_;
  bus::MemoryTransport& controller_;
  std::exception_ptr failure_;
  rt::Usage usage_;
};

}  // namespace reed
