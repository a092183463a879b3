// [[fault]]: one fault of the simulated arm's sensors, drives, nodes or bus: where, what, how much, from when to when, and
// what is expected of the controller. Kinds and targets: docs/faults.md. RT: set-up only (it owns heap memory).
#pragma once

#include <string>

namespace reed {

struct FaultConfig {
  enum class Edge { kRising, kFalling };

  std::string id;
  std::string target;  // joint2.encoder, wrench.frame, bus ...
  std::string kind;
  double size = 0.0;  // unit: the kind's; 0: the kind's usual size
  // What starts it, one of:
  double from_s = -1.0;  // since the drives were enabled; -1: not by time
  int from_cycle = -1;
  std::string from_mode;   // of the drives
  std::string from_event;  // or the id of another fault that begins
  std::string signal;      // passes level in the direction of edge and stays there for for_s
  Edge edge = Edge::kRising;
  double level = 0.0;
  double for_s = 0.0;
  // How it goes on:
  double delay_s = 0.0;      // after the trigger
  double duration_s = 0.0;   // 0: to the end
  bool once = true;          // false: at every trigger
  double probability = 1.0;  // of acting, in each cycle of the window; from the seed
  bool announced = false;    // the device reports it
  // What is expected, for reports:
  std::string detected_by;      // names of reasons or events, with commas
  double within_ms = 0.0;       // from the fault to its detection; 0: not stated
  std::string reaction;         // trip, source, hold, none
  double safe_within_ms = 0.0;  // from the fault to the safe state; 0: not stated
  std::string requirement;
};

}  // namespace reed
