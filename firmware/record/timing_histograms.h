// The histograms of a run: filled by the recorder's thread from the snapshots, so that they cost the loop
// nothing. RT: not for the loop.
#pragma once

#include <reed/histogram_t.hpp>

#include "reed/firmware/record/histogram.h"
#include "reed/firmware/snapshot/snapshot.h"

namespace reed::telemetry {

class TimingHistograms {
 public:
  static constexpr std::array<const char*, 5> kNames{"wake", "rx", "compute", "tx", "cycle"};

  void Add(const Timing& t) noexcept {
    const std::array<std::int32_t, kNames.size()> values{t.wake_ns, t.rx_ns, t.compute_ns, t.tx_ns,
                                                         t.cycle_ns};
    for (std::size_t i = 0; i < values.size(); ++i) histogram_[i].Add(values[i]);
  }

  /// Fills `out` with histogram i of kNames.
  void Fill(std::size_t i, std::int64_t cycle, std::int64_t utime, reed::histogram_t& out) const {
    const Histogram& from = histogram_[i];
    out.utime = utime;
    out.cycle = cycle;
    out.name = kNames[i];
    out.count = from.count();
    out.max_ns = from.max_ns();
    out.p50_ns = from.Quantile(0.5);
    out.p99_ns = from.Quantile(0.99);
    out.p999_ns = from.Quantile(0.999);
    for (std::size_t width = 1; !FillBins(from, width, out); width *= 2) {
    }
  }

 private:
  static constexpr std::size_t kMaxBins = 80;  // of one message, so that it fits one datagram

  /// Bins with counts, `width` neighbours taken together. False: still too many.
  static bool FillBins(const Histogram& from, std::size_t width, reed::histogram_t& out) {
    out.low_ns.clear();
    out.high_ns.clear();
    out.counts.clear();
    for (std::size_t bin = 0; bin < Histogram::kBins; bin += width) {
      const std::size_t end = std::min(bin + width, Histogram::kBins);
      std::int64_t count = 0;
      for (std::size_t i = bin; i < end; ++i) count += from.bins()[i];
      if (count == 0) continue;
      if (out.counts.size() == kMaxBins) return false;
      out.low_ns.push_back(Histogram::LowEnd(bin));
      out.high_ns.push_back(end < Histogram::kBins ? Histogram::LowEnd(end) - 1 : 0x7FFFFFFF);
      out.counts.push_back(count);
    }
    out.num = static_cast<std::int32_t>(out.counts.size());
    return true;
  }

  std::array<Histogram, kNames.size()> histogram_;
};

}  // namespace reed::telemetry
