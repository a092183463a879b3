// The elementary functions over arrays, for tests in Python.
#include "reed/math/exponential.h"
#include "reed/math/plane.h"
#include "reed/math/sine.h"

extern "C" {

#define REED_EACH(name, value)                                           \
  void name(const double* x, const double* y, double* out, long count) { \
    for (long i = 0; i < count; ++i) out[i] = reed::math::value;         \
  }

REED_EACH(Sin, Sin(x[i]))
REED_EACH(Cos, Cos(x[i]))
REED_EACH(Exp, Exp(x[i]))
REED_EACH(ExpM1, ExpM1(x[i]))
REED_EACH(Log, Log(x[i]))
REED_EACH(Tanh, Tanh(x[i]))
REED_EACH(Atan2, Atan2(y[i], x[i]))
REED_EACH(Length, Length(x[i], y[i]))
REED_EACH(SinFirst, SinCos(x[i], y[i]).sine.first())
REED_EACH(CosFirst, SinCos(x[i], y[i]).cosine.first())
REED_EACH(SinSecond, SinCos(x[i], y[i]).sine.second())
REED_EACH(CosSecond, SinCos(x[i], y[i]).cosine.second())
}
