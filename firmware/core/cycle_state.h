// What the loop passes to the controller with a measurement: lateness and the operator's requests. RT: safe.
#pragma once

namespace reed {

struct CycleState {
  bool stop_wanted = false;
  bool missed_in_row_exceeded = false;
  int missed_in_row = 0;
  bool phase_budget_exceeded = false;  // in too many cycles in a row
  int broken_in_row = 0;
  bool gap = false;           // more than a period has passed since the last cycle
  bool hold = false;          // after an overrun or a broken budget: repeat the last command
  bool degrade = false;       // leave out what can wait
  bool all_answered = false;  // every joint has answered this cycle
};

}  // namespace reed
