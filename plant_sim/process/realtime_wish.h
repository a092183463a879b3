// What the plant asks of the machine on the wall clock. RT: set-up only.
#pragma once

#include "reed/config/description/cores.h"
#include "reed/rt/realtime_scope.h"

namespace reed::plant {

/// The controller's core and its priority. Level with the loop: on one CPU neither interrupts the other, so an
/// answer is complete before the loop sees its first frame, and a command is recorded before the plant acts on
/// it. Apart, each frame costs two context switches. Every page now and later: a page fault in a step costs
/// more than the step.
inline rt::RealtimeOptions RealtimeWish(const TimingConfig& timing) {
  rt::RealtimeOptions wish;
  wish.priority = timing.priority;
  wish.cpu = PlantCore(timing);
  wish.cpu_key = timing.plant_cpu >= 0 ? "timing.plant_cpu" : "timing.cpu";
  wish.lock_later_pages = true;
  return wish;
}

}  // namespace reed::plant
