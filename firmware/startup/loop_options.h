// The scenario's [timing] -> the options of the loop. RT: set-up only.
#pragma once

#include "reed/config/description/scenario.h"
#include "reed/firmware/loop/loop.h"

namespace reed {

LoopOptions LoopOptionsFrom(const TimingConfig& timing);

}  // namespace reed
