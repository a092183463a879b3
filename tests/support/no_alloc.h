// The heap promise as a test guard, in every build but a sanitizer's: nothing between construction and
// destruction may touch the heap on this thread. The test links reed_heap_guard.
#pragma once

#include <gtest/gtest.h>

#include "reed/rt/heap_guard.h"

namespace reed::test {

class NoAlloc {
 public:
  explicit NoAlloc(const char* what) : what_(what) {}
  ~NoAlloc() {
    const auto calls = count_.calls();
    EXPECT_EQ(calls, 0) << what_ << " touched the heap";
  }
  NoAlloc(const NoAlloc&) = delete;
  NoAlloc& operator=(const NoAlloc&) = delete;

 private:
  const char* what_;
  rt::HeapCount count_;
};

}  // namespace reed::test
