// The scenario's [timing] -> the options of the loop. RT: set-up only.
#pragma once

#include "reed/config/controller/controller_config.h"
#include "reed/firmware/loop/loop.h"

namespace reed {

LoopOptions LoopOptionsFrom(const TimingConfig& timing);

}  // namespace reed
