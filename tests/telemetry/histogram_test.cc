#include "reed/firmware/record/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "reed/firmware/record/encode.h"
#include "reed/firmware/record/timing_histograms.h"

namespace reed::telemetry {
namespace {

TEST(Histogram, EveryValueLiesInItsBinAndBinsAreThreePercentWide) {
  for (std::int64_t value = 0; value < 0x7FFFFFFF; value += std::max<std::int64_t>(value / 100, 1)) {
    const auto v = static_cast<std::int32_t>(value);
    const std::size_t bin = Histogram::BinOf(v);
    EXPECT_LE(Histogram::LowEnd(bin), v);
    if (bin + 1 < Histogram::kBins) {
      EXPECT_GT(Histogram::LowEnd(bin + 1), v);
      EXPECT_LE(Histogram::LowEnd(bin + 1) - Histogram::LowEnd(bin), std::max(1, v / 32 + 1));
    }
  }
}

TEST(Histogram, QuantilesAreThoseOfTheSortedValuesToThreePercent) {
  std::mt19937 engine(1);
  std::lognormal_distribution<double> duration(10.0, 1.5);
  Histogram histogram;
  std::vector<std::int32_t> values;
  for (int i = 0; i < 20'000; ++i) {
    values.push_back(static_cast<std::int32_t>(std::min(duration(engine), 1e9)));
    histogram.Add(values.back());
  }
  std::sort(values.begin(), values.end());
  for (const double q : {0.5, 0.99, 0.999}) {
    const double exact = values[static_cast<std::size_t>(std::ceil(q * 20'000)) - 1];
    EXPECT_NEAR(histogram.Quantile(q), exact, exact / 31.0 + 1.0) << q;
  }
  EXPECT_EQ(histogram.max_ns(), values.back());
  EXPECT_EQ(histogram.Quantile(1.0), values.back());
  EXPECT_EQ(histogram.count(), 20'000);
}

TEST(Histogram, AnEmptyOneAndANegativeValueAreZero) {
  Histogram histogram;
  EXPECT_EQ(histogram.Quantile(0.5), 0);
  histogram.Add(-5);
  EXPECT_EQ(histogram.Quantile(0.5), 0);
  EXPECT_EQ(histogram.count(), 1);
}

TEST(TimingHistograms, AMessageHoldsEveryValueAndFitsOneDatagramHoweverWideTheyScatter) {
  TimingHistograms histograms;
  for (std::int32_t k = 0; k < 5000; ++k) {
    Timing timing;
    timing.rx_ns = k * 400'000;  // 0 ns to 2 s
    timing.compute_ns = 5000;
    histograms.Add(timing);
  }
  MessageEncoder encoder;
  reed::histogram_t message;
  histograms.Fill(1, 77, 88, message);
  EXPECT_EQ(message.name, "rx");
  EXPECT_EQ(message.cycle, 77);
  EXPECT_EQ(message.count, 5000);
  EXPECT_EQ(std::accumulate(message.counts.begin(), message.counts.end(), std::int64_t{0}), 5000);
  EXPECT_LE(encoder.Histogram(message).size(), kMaxMessageBytes);
  histograms.Fill(2, 77, 88, message);
  ASSERT_EQ(message.num, 1);
  EXPECT_LE(message.low_ns[0], 5000);
  EXPECT_GE(message.high_ns[0], 5000);
}

}  // namespace
}  // namespace reed::telemetry
